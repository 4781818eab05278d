//! The summary as JUnit XML, which build servers show.

use std::fmt::Write;

use crate::results::found::Found;
use crate::results::summary::{CaseCount, Summary};

/// A test per class of disagreements, which failed, and per group of cases without any.
pub fn xml(summary: &Summary) -> String {
    let passed: Vec<&CaseCount> =
        summary.groups.iter().filter(|group| group.disagreements == 0).collect();
    let failures = summary.classes.len();
    let errors = usize::from(summary.interrupted);
    let right = summary.vectors > 0 && summary.wrong_vectors().is_empty();
    let tests = passed.len() + usize::from(right) + failures + errors;
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "<testsuites tests=\"{tests}\" failures=\"{failures}\">\n\
         <testsuite name=\"mufasa conform\" tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\" \
         skipped=\"0\">"
    );
    if right {
        let name = format!("vectors ({})", summary.vectors);
        let _ = writeln!(text, "<testcase classname=\"mufasa\" name=\"{name}\"/>");
    }
    for CaseCount { kind, profile, configuration, expected, cases, .. } in passed {
        let parts = [kind.name(), profile, configuration, expected];
        let words: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let name = xml_text(&format!("{} ({cases} cases)", words.join(" ")));
        let _ = writeln!(text, "<testcase classname=\"mufasa.{}\" name=\"{name}\"/>", kind.name());
    }
    for found in &summary.classes {
        let Found { class, id, count, told, record, before, .. } = found;
        let (kind, name) = (class.kind.name(), xml_text(&class.to_string()));
        let message = xml_text(&format!("{count} cases; exact: {}", told.expected));
        let mut body = format!("program: {}\nexact: {}\n", told.answered, told.expected);
        if let Some(numbers) = &told.numbers {
            let _ = writeln!(
                body,
                "decides: {}\n{} against {}, margin {}",
                numbers.what, numbers.left, numbers.right, numbers.margin
            );
        }
        if let Some(delta) = found.delta() {
            let _ = writeln!(body, "delta: {delta} m, the record's own margin");
        }
        if !before.is_empty() {
            let _ = writeln!(body, "does not occur alone: sequence.{id}.jsonl");
        }
        if !found.is_tried() {
            let _ = writeln!(body, "not shrunk");
        }
        let _ = writeln!(body, "record: {}", record.get());
        let _ = writeln!(
            text,
            "<testcase classname=\"mufasa.{kind}\" name=\"{name}\"><failure type=\"{}\" \
             message=\"{message}\">{}</failure></testcase>",
            class.breach.name(),
            xml_text(&body)
        );
    }
    if summary.interrupted {
        let asked = format!("{} of {} cases", summary.asked, summary.campaign.cases);
        let _ = writeln!(
            text,
            "<testcase classname=\"mufasa\" name=\"the whole campaign\"><error \
             type=\"interrupted\" message=\"interrupted after {asked}\"/></testcase>"
        );
    }
    text.push_str("</testsuite>\n</testsuites>\n");
    text
}

/// Text for XML: markup escaped, characters that XML cannot hold replaced.
pub fn xml_text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\u{9}' | '\u{d}' | '\u{20}'..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'.. => {
                out.push(c);
            }
            _ => out.push('\u{fffd}'),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_xml_text() {
        assert_eq!(xml_text("a<b & \"c\"\u{0}\n"), "a&lt;b &amp; &quot;c&quot;\u{fffd}&#10;");
    }
}
