//! Pictures of a safety case: an element on the left, and what stands below it to its right.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::gsn::{Case, Element};

const WIDTH: usize = 232;
const GAP: usize = 46;
const LINE: usize = 14;
const LETTERS: usize = 36;

const STYLE: &str = "text{font:11px 'DejaVu Sans',Verdana,Helvetica,sans-serif;fill:#1d2733;text-anchor:middle}\
    .id{font-weight:bold}.note{font-size:9px}rect,path{fill:#fff;stroke:#1d2733}\
    .supportedBy,.inContextOf,.challenges{fill:none}.full{fill:#1d2733}\
    .Sn{fill:#eef5ea}.C,.A,.J{fill:#f3f3f3}.S{fill:#eaf0f8}\
    .CG{fill:#fdeeee}.CG,.challenges{stroke:#b3001f;stroke-dasharray:5 3}.against{fill:#b3001f;stroke:#b3001f}";

struct Picture<'a> {
    case: &'a Case,
    module: &'a str,
    drawn: BTreeSet<&'a str>,
    right: usize,
    parts: String,
}

/// The picture of a module. Of what stands in another module it has the text alone.
pub fn svg(case: &Case, module: &str) -> String {
    let (drawn, parts) = (BTreeSet::new(), String::new());
    let mut picture = Picture { case, module, drawn, right: 0, parts };
    let mut bottom = 10;
    for root in case.roots(Some(module)) {
        bottom = 10 + picture.place(root, 10, bottom, None);
    }
    let (width, parts) = (picture.right + 10, picture.parts);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{bottom}\" \
         viewBox=\"0 0 {width} {bottom}\">\n<title>Safety case: {module}</title>\n<style>{STYLE}</style>\n\
         <rect width=\"100%\" height=\"100%\" style=\"stroke:none\"/>\n{parts}</svg>\n"
    )
}

impl<'a> Picture<'a> {
    /// Draws an element at x and y, with what is below it and the line from above; returns where the next one begins.
    fn place(&mut self, it: &'a Element, x: usize, y: usize, from: Option<(&str, usize)>) -> usize {
        let is_new = self.drawn.insert(&it.id);
        let is_here = it.module == self.module;
        let lines = if is_new { wrapped(it.word("text")) } else { vec!["(above)".to_owned()] };
        let elsewhere = format!("{}.svg", it.module);
        let note = if is_here { it.word("artefact") } else { &elsewhere };
        let height = 12 + LINE * (1 + lines.len() + usize::from(!note.is_empty()));
        let middle = y + height / 2;
        self.right = self.right.max(x + WIDTH);
        if let Some((key, above)) = from {
            self.line(key, above, x, middle);
        }
        self.shape(it, x, y, height);
        let note = (!note.is_empty()).then_some(("note", note));
        let text = lines.iter().map(|line| ("text", line.as_str())).chain(note);
        for (row, (class, line)) in [("id", it.id.as_str())].into_iter().chain(text).enumerate() {
            let (x, y) = (x + WIDTH / 2, y + 16 + LINE * row);
            self.add(&format!(
                "<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{}</text>",
                escaped(line)
            ));
        }
        let mut next = y;
        if is_new && is_here {
            for (key, below) in self.case.below(it) {
                next = self.place(below, x + WIDTH + GAP, next, Some((key, middle)));
            }
        }
        next.max(y + height + if it.is_undeveloped() { 16 } else { 8 })
    }

    /// The box of an element, and the diamond of what is undeveloped.
    fn shape(&mut self, it: &Element, x: usize, y: usize, height: usize) {
        let (kind, bottom, right) = (it.kind(), y + height, x + WIDTH);
        let round = match kind {
            "Sn" | "A" | "J" => 24,
            "C" => 10,
            _ => 0,
        };
        if kind == "S" {
            let (a, b) = (x + 10, right - 10);
            self.add(&format!("<path class=\"S\" d=\"M{a},{y} H{right} L{b},{bottom} H{x} z\"/>"));
        } else {
            self.add(&format!(
                "<rect class=\"{kind}\" x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{height}\" rx=\"{round}\"/>"
            ));
        }
        if it.is_undeveloped() {
            let x = x + WIDTH / 2;
            self.add(&format!("<path d=\"M{x},{bottom} l7,6 -7,6 -7,-6 z\"/>"));
        }
    }

    /// The arrow between an element whose middle is `above` and one at x, whose middle is y.
    fn line(&mut self, key: &str, above: usize, x: usize, y: usize) {
        let left = x - GAP;
        if key == "challenges" {
            let (at, turn) = (above + 6, left + GAP / 2 + 4);
            self.add(&format!(
                "<path class=\"{key}\" d=\"M{x},{y} H{turn} V{at} H{}\"/>",
                left + 7
            ));
            self.add(&format!("<path class=\"against\" d=\"M{left},{at} l8,-4 v8 z\"/>"));
        } else {
            let class = if key == "supportedBy" { "full" } else { "open" };
            let turn = left + GAP / 2 - 4;
            self.add(&format!(
                "<path class=\"{key}\" d=\"M{left},{above} H{turn} V{y} H{}\"/>",
                x - 7
            ));
            self.add(&format!("<path class=\"{class}\" d=\"M{x},{y} l-8,-4 v8 z\"/>"));
        }
    }

    fn add(&mut self, part: &str) {
        writeln!(self.parts, "{part}").expect("a string takes all");
    }
}

/// Lines of at most so many letters, where no word is longer.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().expect("there is one");
        if last.is_empty() {
            last.push_str(word);
        } else if last.len() + 1 + word.len() > LETTERS {
            lines.push(word.to_owned());
        } else {
            last.push(' ');
            last.push_str(word);
        }
    }
    lines
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[test]
fn lines_are_short_and_keep_all_words() {
    let text = "one word after another until there is no more room for any of them in this line";
    assert_eq!(wrapped(text).join(" "), text);
    assert!(wrapped(text).iter().all(|line| line.len() <= LETTERS));
    assert_eq!(escaped("a < b"), "a &lt; b");
}
