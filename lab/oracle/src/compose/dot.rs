//! The graph in the language of Graphviz.

use super::graph::Graph;

/// Colour of the CAV, then of the other stations in turn; the first two are those of the paper's Fig. 2.
const COLOURS: [&str; 7] =
    ["#67acd4", "#ea7f81", "#8dbf7a", "#e5b567", "#a98fc9", "#6fbfb0", "#c9a58f"];

/// The goal at the top, arrows from provider to consumer, device switches dashed.
pub fn draw(graph: &Graph) -> String {
    let mut lines = vec![
        String::from("digraph services {"),
        String::from("  rankdir=BT;"),
        String::from("  node [shape=box, style=\"rounded,filled\", fontname=\"sans-serif\"];"),
    ];
    for (index, node) in graph.nodes.iter().enumerate() {
        lines.push(format!(
            "  n{index} [label={}, fillcolor=\"{}\"];",
            quoted(&node.id),
            colour(node.station)
        ));
    }
    for edge in &graph.edges {
        let style = if edge.switch { ", style=dashed" } else { "" };
        let label = quoted(&edge.interfaces.join(", "));
        lines.push(format!("  n{} -> n{} [label={label}{style}];", edge.provider, edge.consumer));
    }
    lines.push(String::from("}\n"));
    lines.join("\n")
}

/// Fill colour of a station.
fn colour(station: i64) -> &'static str {
    let others = COLOURS.len() - 1;
    match usize::try_from(station) {
        Ok(0) => COLOURS[0],
        Ok(station) => COLOURS[1 + (station - 1) % others],
        // No service set holds a negative station.
        Err(_) => "#ffffff",
    }
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            control if control.is_control() => quoted.push('\u{fffd}'),
            other => quoted.push(other),
        }
    }
    quoted.push('"');
    quoted
}
