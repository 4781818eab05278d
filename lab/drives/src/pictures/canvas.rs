//! Writes SVG elements: escaping, rounding, and nothing that is not finite.

use std::fmt::Write as _;

/// An SVG document that grows; coordinates in px.
#[derive(Default)]
pub struct Canvas {
    body: String,
}

impl Canvas {
    /// The whole file of a size, px, on white: a title, which is no part of the picture, and what classes look like.
    pub fn document(self, [width, height]: [f64; 2], title: &str, style: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\">\n<title>{}</title>\n<style>{style}</style>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
            escape(title),
            self.body
        )
    }

    /// Opens a group of which nothing is seen outside of a rectangle; `id`: a name that no other has.
    pub fn clip(&mut self, id: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        let _ = writeln!(
            self.body,
            "<clipPath id=\"{id}\"><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>\
             </clipPath>"
        );
        self.open(&format!("clip-path=\"url(#{id})\""));
    }

    /// Opens a group; `attributes` are written as they are.
    pub fn open(&mut self, attributes: &str) {
        let _ = writeln!(self.body, "<g {attributes}>");
    }

    /// Closes the group opened last.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A closed polygon; left out when a corner cannot be drawn.
    pub fn polygon(&mut self, corners: &[Option<[f64; 2]>], class: &str) {
        if let Some(points) = points(corners) {
            let _ = writeln!(self.body, "<polygon class=\"{class}\" points=\"{points}\"/>");
        }
    }

    /// An open line through the points; left out when one cannot be drawn.
    pub fn polyline(&mut self, line: &[Option<[f64; 2]>], class: &str) {
        if let Some(points) = points(line) {
            let _ = writeln!(self.body, "<polyline class=\"{class}\" points=\"{points}\"/>");
        }
    }

    /// The same, so wide.
    pub fn band(&mut self, line: &[Option<[f64; 2]>], width: f64, class: &str) {
        self.polyline(line, &format!("{class}\" stroke-width=\"{width:.1}"));
    }

    /// The head of an arrow, so long; none where the arrow is shorter.
    pub fn tip(&mut self, from: [f64; 2], to: [f64; 2], long: f64, class: &str) {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        if length > long {
            let [x, y] = way.map(|it| it / length * long);
            let side = |k: f64| Some([to[0] - x - k * y, to[1] - y + k * x]);
            self.polygon(&[Some(to), side(0.45), side(-0.45)], class);
        }
    }

    /// A circle with centre and radius in px.
    pub fn circle(&mut self, centre: Option<[f64; 2]>, radius: f64, class: &str) {
        if let Some([x, y]) = centre
            && radius.is_finite()
        {
            let _ = writeln!(
                self.body,
                "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
            );
        }
    }

    /// A rectangle along the axes of the page.
    pub fn rect(&mut self, corner: [f64; 2], size: [f64; 2], class: &str) {
        let ([x, y], [w, h]) = (corner, size);
        let _ = writeln!(
            self.body,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\"/>"
        );
    }

    /// A line of text; `class` chooses size and anchor.
    pub fn text(&mut self, at: Option<[f64; 2]>, class: &str, text: &str) {
        if let Some([x, y]) = at {
            let text = escape(text);
            let _ = writeln!(
                self.body,
                "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>"
            );
        }
    }
}

/// Replaces what XML reserves, and control characters, which XML 1.0 cannot hold.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

fn points(of: &[Option<[f64; 2]>]) -> Option<String> {
    let mut out = String::new();
    for point in of {
        let [x, y] = (*point)?;
        let _ = write!(out, "{x:.1},{y:.1} ");
    }
    out.pop();
    (!out.is_empty()).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_and_control_characters_never_reach_the_document() {
        assert_eq!(escape("a<b>&\"\u{1}"), "a&lt;b&gt;&amp;&quot;\u{fffd}");
    }

    #[test]
    fn a_polygon_with_a_corner_that_cannot_be_drawn_is_left_out() {
        let mut canvas = Canvas::default();
        canvas.polygon(&[Some([0.0, 0.0]), None], "c");
        canvas.polygon(&[], "c");
        assert_eq!(canvas.body, "");
    }
}
