//! The graph as a picture (paper Fig. 2): the goal at the top, boxes coloured by station, arrows
//! from provider to consumer, device switches dashed. The crate `layout-rs` finds the places.

use layout::core::base::Orientation;
use layout::core::format::{ClipHandle, RenderBackend, Visible as _};
use layout::core::geometry::Point;
use layout::core::style::{LineStyleKind, StyleAttr};
use layout::std_shapes::shapes::{Arrow, Element, LineEndKind, ShapeKind};
use layout::topo::layout::VisualGraph;
use mufasa_drives::pictures::escape;

use super::graph::{Graph, station_name};

/// px
const BOX_HEIGHT: f64 = 44.0;
const BORDER: f64 = 28.0;
const TITLE_HEIGHT: f64 = 44.0;
const NOTE_HEIGHT: f64 = 36.0;
const FONT_SIZE: f64 = 14.0;
/// Below the graph.
const NOTE: &str = "An arrow: provides for. Dashed: a device switch.";
/// Longest label, characters; the whole id is in the tooltip.
const LABEL_CHARS: usize = 32;
/// Colour of the CAV, then of the other stations in turn; the first two are the paper's.
const COLOURS: [&str; 7] =
    ["#67acd4", "#ea7f81", "#8dbf7a", "#e5b567", "#a98fc9", "#6fbfb0", "#c9a58f"];
const LINK: &str = "#333333";
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
    let mut sheet = VisualGraph::new(Orientation::TopToBottom);
    // `downwards` leaves no cycle; looking for one after every edge takes exponential time.
    sheet.dag.set_validate(false);
    let labels = graph.nodes.iter().map(|node| [label(&node.id), station_name(node.station)]);
    let labels: Vec<[String; 2]> = labels.collect();
    let element = |lines: &[String; 2]| {
        let width = text_width(&lines[0]).max(0.8 * text_width(&lines[1]));
        let size = Point::new(width + 28.0, BOX_HEIGHT);
        sheet.add_node(Element::create(
            ShapeKind::new_box(&lines[0]),
            StyleAttr::simple(),
            Orientation::TopToBottom,
            size,
        ))
    };
    let nodes: Vec<_> = labels.iter().map(element).collect();
    for (arrow, from, to) in downwards(graph) {
        sheet.add_edge(arrow, nodes[from], nodes[to]);
    }
    let mut page = Page::default();
    sheet.do_it(false, false, false, &mut page);
    for ((node, [label, station]), handle) in graph.nodes.iter().zip(&labels).zip(nodes) {
        let place = sheet.element(handle).position();
        let ([x, y], size, middle) = (xy(place.bbox(false).0), place.size(false), place.center());
        page.reach([x, y]);
        page.reach([x + size.x, y + size.y]);
        page.elements.push(format!(
            "<g><title>{}, {station}</title><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"8\" \
             fill=\"{}\" stroke=\"{LINK}\"/><text class=\"middle\" x=\"{mx:.1}\" y=\"{:.1}\">{}</text>\
             <text class=\"middle station\" x=\"{mx:.1}\" y=\"{:.1}\">{station}</text></g>",
            escape(&node.id),
            size.x,
            size.y,
            colour(node.station),
            middle.y - 3.0,
            escape(label),
            middle.y + 14.0,
            mx = middle.x,
        ));
    }
    page.finish(title)
}

/// The links, each from its end nearer to the goal to the other, ordered by the first; the arrow
/// head is at the consumer, which is the end nearer to the goal unless the link closes a cycle.
fn downwards(graph: &Graph) -> Vec<(Arrow, usize, usize)> {
    let mut left = Vec::new();
    let mut seen = vec![false; graph.nodes.len()];
    for node in 0..graph.nodes.len() {
        visit(graph, node, &mut seen, &mut left);
    }
    let mut place = vec![0; left.len()];
    for (index, node) in left.iter().rev().enumerate() {
        place[*node] = index;
    }
    let mut links: Vec<_> = graph
        .edges
        .iter()
        .map(|edge| {
            let names = [edge.provider, edge.consumer].map(|node| graph.nodes[node].id.as_str());
            let about = format!("{} to {}: {}", names[0], names[1], edge.interfaces.join(", "));
            let style = if edge.switch { LineStyleKind::Dashed } else { LineStyleKind::Normal };
            let (head, tail) = (LineEndKind::Arrow, LineEndKind::None);
            let up = place[edge.consumer] < place[edge.provider];
            let arrow = Arrow::with_properties(
                head,
                tail,
                style,
                "",
                &StyleAttr::simple(),
                about,
                &None,
                &None,
            );
            if up {
                (arrow, edge.consumer, edge.provider)
            } else {
                (arrow.reverse(), edge.provider, edge.consumer)
            }
        })
        .collect();
    links.sort_by_key(|(_, from, to)| (place[*from], place[*to]));
    links
}

/// Appends the node, after everything that it needs and that is not seen yet.
fn visit(graph: &Graph, node: usize, seen: &mut [bool], left: &mut Vec<usize>) {
    if std::mem::replace(&mut seen[node], true) {
        return;
    }
    for edge in graph.edges.iter().filter(|edge| edge.consumer == node) {
        visit(graph, edge.provider, seen, left);
    }
    left.push(node);
}

fn xy(point: Point) -> [f64; 2] {
    [point.x, point.y]
}

/// Elements, and the lower right corner of all of them.
#[derive(Default)]
struct Page {
    elements: Vec<String>,
    corner: [f64; 2],
}

impl RenderBackend for Page {
    fn draw_arrow(
        &mut self,
        path: &[(Point, Point)],
        dashed: bool,
        (at_start, _): (bool, bool),
        _: &StyleAttr,
        about: Option<String>,
        _: &str,
    ) {
        let class = if dashed { "switch" } else { "link" };
        let end = if at_start { "start" } else { "end" };
        // `M point C control control point S control point ...`
        let step = |(index, (a, b)): (usize, &(Point, Point))| {
            let [before, between] = [["M ", " C "], ["", " "], ["S ", " "]][index.min(2)];
            format!("{before}{:.1} {:.1}{between}{:.1} {:.1}", a.x, a.y, b.x, b.y)
        };
        let d = path.iter().enumerate().map(step).collect::<Vec<_>>().join(" ");
        path.iter().for_each(|(a, b)| [a, b].iter().for_each(|point| self.reach(xy(**point))));
        self.elements.push(format!(
            "<path class=\"{class}\" d=\"{d}\" marker-{end}=\"url(#to-{class})\"><title>{}</title></path>",
            escape(&about.unwrap_or_default())
        ));
    }

    // Boxes are drawn by `draw`, which knows their stations.
    fn draw_rect(
        &mut self,
        _: Point,
        _: Point,
        _: &StyleAttr,
        _: Option<String>,
        _: Option<ClipHandle>,
    ) {
    }
    fn draw_line(&mut self, _: Point, _: Point, _: &StyleAttr, _: Option<String>) {}
    fn draw_circle(&mut self, _: Point, _: Point, _: &StyleAttr, _: Option<String>) {}
    fn draw_text(&mut self, _: Point, _: &str, _: &StyleAttr) {}
    fn create_clip(&mut self, _: Point, _: Point, _: usize) -> ClipHandle {
        0
    }
}

impl Page {
    fn reach(&mut self, point: [f64; 2]) {
        self.corner = [0, 1].map(|axis| self.corner[axis].max(point[axis]));
    }

    /// The document: title, graph and note, one below the other, all centred.
    fn finish(self, title: &str) -> String {
        let [width, height] = self.corner;
        let inner = width.max(text_width(NOTE)).max(text_width(title) * 1.15);
        let (page_width, note_y) = (inner + 2.0 * BORDER, TITLE_HEIGHT + height + BORDER);
        let (page_height, middle) = (note_y + NOTE_HEIGHT, page_width / 2.0);
        let (title, elements) = (escape(title), self.elements.join("\n"));
        let markers = [("link", LINK), ("switch", SWITCH)].map(|(class, fill)| {
            format!(
                "<marker id=\"to-{class}\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"9\" \
                 markerHeight=\"9\" markerUnits=\"userSpaceOnUse\" orient=\"auto-start-reverse\">\
                 <path d=\"M 0 0 L 10 5 L 0 10 z\" fill=\"{fill}\"/></marker>"
            )
        });
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{page_width:.0}\" height=\"{page_height:.0}\" \
             viewBox=\"0 0 {page_width:.1} {page_height:.1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" \
             font-size=\"{FONT_SIZE}\">\n<title>{title}</title>\n<defs>{}</defs>\n\
             <style>.link {{ fill: none; stroke: {LINK}; stroke-width: 1.3 }} .switch {{ fill: none; \
             stroke: {SWITCH}; stroke-width: 1.8; stroke-dasharray: 7 4 }} .middle {{ text-anchor: middle }} \
             .title {{ font-size: 16px }} .station {{ font-size: 11px }}</style>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text class=\"middle title\" x=\"{middle:.1}\" y=\"{TITLE_HEIGHT}\">{title}</text>\n\
             <g transform=\"translate({:.1} {TITLE_HEIGHT})\">\n{elements}\n</g>\n\
             <text class=\"middle\" x=\"{middle:.1}\" y=\"{note_y:.1}\">{NOTE}</text>\n</svg>\n",
            markers.concat(),
            (page_width - width) / 2.0,
        )
    }
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
