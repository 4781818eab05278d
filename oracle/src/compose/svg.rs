//! The graph as a picture (paper Fig. 2): the goal at the top, boxes coloured by station, arrows
//! from provider to consumer, device switches dashed.

use super::graph::{Edge, Graph, station_name};
use super::layout::{Layout, lay_out};

/// px
const BOX_HEIGHT: f64 = 34.0;
const LAYER_STEP: f64 = 96.0;
const BORDER: f64 = 28.0;
const TITLE_HEIGHT: f64 = 44.0;
const LEGEND_HEIGHT: f64 = 54.0;
/// How far the control points of a detour lie beside the boxes.
const REACH: f64 = 48.0;
const FONT_SIZE: f64 = 14.0;
/// Longest label, characters; the whole id is in the tooltip.
const LABEL_CHARS: usize = 32;
/// Colour of the CAV, then of the other stations in turn; the first two are the paper's.
const COLOURS: [&str; 7] =
    ["#67acd4", "#ea7f81", "#8dbf7a", "#e5b567", "#a98fc9", "#6fbfb0", "#c9a58f"];
const SWITCH: &str = "#b81414";

/// Fill colour of a station.
pub fn colour(station: i64) -> &'static str {
    let others = COLOURS.len() - 1;
    match usize::try_from(station) {
        Ok(0) => COLOURS[0],
        Ok(station) => COLOURS[1 + (station - 1) % others],
        // No service set holds a negative station.
        Err(_) => "#ffffff",
    }
}

/// Draws the graph below a title.
pub fn draw(graph: &Graph, title: &str) -> String {
    let labels: Vec<String> = graph.nodes.iter().map(|node| label(&node.id)).collect();
    let widths: Vec<f64> = labels.iter().map(|label| text_width(label) + 28.0).collect();
    let layout = lay_out(graph, &widths);
    let legend = Legend::of(graph);
    let inner = (layout.width + 2.0 * REACH).max(legend.width).max(text_width(title) * 1.15);
    let page = Page { left: BORDER + (inner - layout.width) / 2.0, layout, widths };
    let width = inner + 2.0 * BORDER;
    let legend_top = top(page.layout.layers.saturating_sub(1)) + BOX_HEIGHT + BORDER;
    let height = legend_top + LEGEND_HEIGHT;

    let mut out = head(width, height, title);
    for (index, edge) in graph.edges.iter().enumerate() {
        let (class, marker) = if edge.switch { ("switch", "to-switch") } else { ("link", "to") };
        let path = page.path(graph, index);
        let about = escape(&format!(
            "{} to {}: {}",
            graph.nodes[edge.provider].id,
            graph.nodes[edge.consumer].id,
            edge.interfaces.join(", ")
        ));
        out.push(format!(
            "<path class=\"{class}\" d=\"{path}\" marker-end=\"url(#{marker})\"><title>{about}</title></path>"
        ));
    }
    for (index, node) in graph.nodes.iter().enumerate() {
        let (x, y) = (page.x(index), top(page.layout.layer[index]));
        out.push(format!(
            "<g><title>{}</title>{}<text class=\"label\" x=\"{x:.1}\" y=\"{:.1}\">{}</text></g>",
            escape(&format!("{}, {}", node.id, station_name(node.station))),
            swatch(x - page.widths[index] / 2.0, y, page.widths[index], node.station),
            y + BOX_HEIGHT / 2.0 + FONT_SIZE * 0.35,
            escape(&labels[index])
        ));
    }
    legend.draw(&mut out, (width - legend.width) / 2.0, legend_top);
    out.push(String::from("</svg>\n"));
    out.join("\n")
}

/// A layout on the page.
struct Page {
    layout: Layout,
    widths: Vec<f64>,
    left: f64,
}

impl Page {
    fn x(&self, node: usize) -> f64 {
        self.left + self.layout.x[node]
    }

    /// From the top of the provider, straight up through its lanes, to the bottom of the consumer.
    fn path(&self, graph: &Graph, index: usize) -> String {
        let edge = &graph.edges[index];
        if !self.rises(edge) {
            return self.detour(edge);
        }
        let upwards = |e: &&Edge| e.provider == edge.provider && self.rises(e);
        let downwards = |e: &&Edge| e.consumer == edge.consumer && self.rises(e);
        let leaves = self.port(graph, edge.provider, index, upwards);
        let arrives = self.port(graph, edge.consumer, index, downwards);
        let (from, to) = (self.layout.layer[edge.provider], self.layout.layer[edge.consumer]);
        let mut y = top(from);
        let mut path = vec![format!("M {leaves:.1} {y:.1}")];
        let mut x = leaves;
        for (lane, layer) in self.layout.lanes[index].iter().rev().zip((to + 1..from).rev()) {
            let (next, bottom) = (self.left + lane, top(layer) + BOX_HEIGHT);
            path.push(curve([x, y], [next, bottom]));
            y = top(layer);
            path.push(format!("V {y:.1}"));
            x = next;
        }
        path.push(curve([x, y], [arrives, top(to) + BOX_HEIGHT + 1.0]));
        path.join(" ")
    }

    /// Whether the consumer lies above the provider, which is so unless the edge closes a cycle.
    fn rises(&self, edge: &Edge) -> bool {
        self.layout.layer[edge.consumer] < self.layout.layer[edge.provider]
    }

    /// From the right side of the provider round to the right side of the consumer.
    fn detour(&self, edge: &Edge) -> String {
        let side = |node: usize, y: f64| {
            let right = self.x(node) + self.widths[node] / 2.0;
            (right, top(self.layout.layer[node]) + BOX_HEIGHT * y)
        };
        let ((x, y), (to_x, to_y)) = (side(edge.provider, 0.25), side(edge.consumer, 0.75));
        let reach = x.max(to_x) + REACH;
        format!(
            "M {x:.1} {y:.1} C {reach:.1} {y:.1} {reach:.1} {to_y:.1} {:.1} {to_y:.1}",
            to_x + 1.0
        )
    }

    /// Where an edge meets the side of a node: the edges there share it from left to right.
    fn port(
        &self,
        graph: &Graph,
        node: usize,
        index: usize,
        meets: impl Fn(&&Edge) -> bool,
    ) -> f64 {
        let mut here: Vec<(f64, usize)> = graph
            .edges
            .iter()
            .enumerate()
            .filter(|(_, edge)| meets(edge))
            .map(|(other, edge)| {
                let lanes = &self.layout.lanes[other];
                let provides = edge.provider == node;
                let lane = if provides { lanes.last() } else { lanes.first() };
                let end = if provides { edge.consumer } else { edge.provider };
                (lane.copied().unwrap_or(self.layout.x[end]), other)
            })
            .collect();
        here.sort_by(|a, b| a.0.total_cmp(&b.0));
        let place = here.iter().position(|(_, other)| *other == index).unwrap_or(0);
        let [place, all] = [place, here.len()].map(|n| u32::try_from(n).map_or(1.0, f64::from));
        let step = (0.7 * self.widths[node] / all).min(22.0);
        self.x(node) + (place + 0.5 - all / 2.0) * step
    }
}

/// Upper side of the boxes of a layer.
#[expect(clippy::cast_precision_loss, reason = "a page has less than 2^52 layers")]
fn top(layer: usize) -> f64 {
    TITLE_HEIGHT + BORDER + layer as f64 * LAYER_STEP
}

/// Vertical at both ends.
fn curve([x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> String {
    let middle = f64::midpoint(y, to_y);
    format!("C {x:.1} {middle:.1} {to_x:.1} {middle:.1} {to_x:.1} {to_y:.1}")
}

/// Swatches with names side by side.
struct Legend {
    stations: Vec<(i64, String)>,
    switch: bool,
    width: f64,
}

/// Widths of a swatch, of a sample of an arrow, and of the room after an entry, px.
const SWATCH_WIDTH: f64 = 26.0;
const ARROW_WIDTH: f64 = 44.0;
const ENTRY_GAP: f64 = 26.0;
const LINK_NAME: &str = "provides for";
const SWITCH_NAME: &str = "device switch";

impl Legend {
    fn of(graph: &Graph) -> Self {
        let stations: Vec<(i64, String)> =
            graph.stations().into_iter().map(|station| (station, station_name(station))).collect();
        let switch = graph.edges.iter().any(|edge| edge.switch);
        let mut width: f64 = stations.iter().map(|(_, name)| entry_width(SWATCH_WIDTH, name)).sum();
        width += entry_width(ARROW_WIDTH, LINK_NAME);
        if switch {
            width += entry_width(ARROW_WIDTH, SWITCH_NAME);
        }
        Self { stations, switch, width: width - ENTRY_GAP }
    }

    fn draw(&self, out: &mut Vec<String>, left: f64, top: f64) {
        let mut x = left;
        let text = |x: f64, name: &str| {
            format!("<text x=\"{x:.1}\" y=\"{:.1}\">{name}</text>", top + 17.0)
        };
        for (station, name) in &self.stations {
            out.push(format!(
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"{SWATCH_WIDTH}\" height=\"18\" rx=\"5\" \
                 fill=\"{}\" stroke=\"#333333\"/>",
                top + 3.0,
                colour(*station)
            ));
            out.push(text(x + SWATCH_WIDTH + 8.0, name));
            x += entry_width(SWATCH_WIDTH, name);
        }
        let arrows = [("link", "to", LINK_NAME), ("switch", "to-switch", SWITCH_NAME)];
        for (class, marker, name) in arrows.into_iter().take(if self.switch { 2 } else { 1 }) {
            let (y, end) = (top + 12.0, x + ARROW_WIDTH - 4.0);
            out.push(format!(
                "<path class=\"{class}\" d=\"M {x:.1} {y:.1} H {end:.1}\" marker-end=\"url(#{marker})\"/>"
            ));
            out.push(text(x + ARROW_WIDTH + 8.0, name));
            x += entry_width(ARROW_WIDTH, name);
        }
    }
}

fn entry_width(sample: f64, name: &str) -> f64 {
    sample + 8.0 + text_width(name) + ENTRY_GAP
}

fn head(width: f64, height: f64, title: &str) -> Vec<String> {
    let marker = |id: &str, fill: &str| {
        format!(
            "<marker id=\"{id}\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"9\" \
             markerHeight=\"9\" markerUnits=\"userSpaceOnUse\" orient=\"auto\">\
             <path d=\"M 0 0 L 10 5 L 0 10 z\" fill=\"{fill}\"/></marker>"
        )
    };
    vec![
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.1} {height:.1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" \
             font-size=\"{FONT_SIZE}\">"
        ),
        format!("<title>{}</title>", escape(title)),
        format!("<defs>{}{}</defs>", marker("to", "#333333"), marker("to-switch", SWITCH)),
        format!(
            "<style>.link {{ fill: none; stroke: #333333; stroke-width: 1.3 }} .switch {{ fill: none; \
             stroke: {SWITCH}; stroke-width: 1.8; stroke-dasharray: 7 4 }} .label {{ text-anchor: middle }} \
             .title {{ text-anchor: middle; font-size: 16px }}</style>"
        ),
        String::from("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"),
        format!(
            "<text class=\"title\" x=\"{:.1}\" y=\"{TITLE_HEIGHT}\">{}</text>",
            width / 2.0,
            escape(title)
        ),
    ]
}

fn swatch(x: f64, y: f64, width: f64, station: i64) -> String {
    format!(
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{BOX_HEIGHT}\" rx=\"8\" \
         fill=\"{}\" stroke=\"#333333\"/>",
        colour(station)
    )
}

fn label(id: &str) -> String {
    let mut chars = id.chars();
    let mut label: String = chars.by_ref().take(LABEL_CHARS).collect();
    if chars.next().is_some() {
        label.push('\u{2026}');
    }
    label
}

/// What a text takes in a wide sans-serif font at most, px.
fn text_width(text: &str) -> f64 {
    let em = |character: char| match character {
        'i' | 'l' | 'j' | 't' | 'f' | 'r' | '.' | ',' | ':' | ' ' | '|' | '(' | ')' | '-' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 1.0,
        upper if upper.is_ascii_uppercase() => 0.78,
        other if other.is_ascii() => 0.64,
        _ => 1.05,
    };
    text.chars().map(em).sum::<f64>() * FONT_SIZE
}

/// Text for XML; what XML 1.0 does not allow becomes a replacement character.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            control if control.is_control() => escaped.push('\u{fffd}'),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}
