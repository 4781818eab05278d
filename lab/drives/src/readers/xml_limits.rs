//! What is asked of XML before it is parsed, by one pass over its bytes: the parser descends
//! recursively, and holds every attribute and every namespace of an element against all others, so
//! that a small file could end it or keep it for minutes.

use std::fmt;

use crate::readers::xml_marks::{Kind, Marks};

/// Limits of a document; files of `CommonRoad` nest less than 10 deep, have less than 10
/// attributes on an element and hardly any namespace.
const DEPTH_MAX: usize = 64;
const ATTRIBUTES_MAX: usize = 256;
const NAMESPACES_MAX: usize = 256;

/// The limit that a document exceeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    Depth,
    Attributes,
    Namespaces,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Depth => write!(f, "elements nest deeper than {DEPTH_MAX}")?,
            Self::Attributes => write!(f, "an element has more than {ATTRIBUTES_MAX} attributes")?,
            Self::Namespaces => write!(f, "more than {NAMESPACES_MAX} namespaces are declared")?,
        }
        f.write_str(", the most that is read; no CommonRoad file needs so many")
    }
}

/// The limit that a text exceeds first. Where the scan stops early, the parser stops with an error
/// at the same place (an unclosed construct, or a document type, which it refuses).
pub(crate) fn exceeded(text: &str) -> Option<Limit> {
    let mut depth: usize = 0;
    let mut namespaces: usize = 0;
    for mark in Marks::of(text) {
        match mark.kind {
            Kind::Open { attributes } | Kind::Empty { attributes } => {
                if attributes > ATTRIBUTES_MAX {
                    return Some(Limit::Attributes);
                }
                // A value with this word counts as well.
                namespaces += text[mark.range].matches("xmlns").count();
                if namespaces > NAMESPACES_MAX {
                    return Some(Limit::Namespaces);
                }
                depth += usize::from(matches!(mark.kind, Kind::Open { .. }));
            }
            Kind::Close => depth = depth.saturating_sub(1),
            Kind::Other | Kind::Broken => {}
        }
        if depth > DEPTH_MAX {
            return Some(Limit::Depth);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::readers::xml::with_root;

    fn many(count: usize, one: impl Fn(usize) -> String) -> String {
        (0..count).map(one).collect()
    }

    #[test]
    fn a_document_too_deep_for_the_parser_is_refused_before_it() {
        let text = "<a>".repeat(1_000_000);
        let error = with_root(Path::new("deep.xml"), &text, |_| Ok(())).unwrap_err();
        assert!(error.message.contains("deeper than 64"), "{error}");
        let hidden = "<a b='/>'><!--</a>--><![CDATA[</a>]]>/>".repeat(100_000);
        let error = with_root(Path::new("deep.xml"), &hidden, |_| Ok(())).unwrap_err();
        assert!(error.message.contains("deeper than 64"), "{error}");
        let wide = format!("<r>{}</r>", "<a b='&gt;'/><c></c>".repeat(1000));
        with_root(Path::new("wide.xml"), &wide, |_| Ok(())).unwrap();
    }

    #[test]
    fn attributes_of_an_element_are_counted_and_not_those_of_all() {
        let of = |n| format!("<r {}/>", many(n, |i| format!(" a{i}='>'")));
        assert_eq!(exceeded(&of(300_000)), Some(Limit::Attributes));
        assert_eq!((exceeded(&of(256)), exceeded(&of(257))), (None, Some(Limit::Attributes)));
        let spread = format!("<r>{}</r>", many(10_000, |i| format!("<x a='{i}' b=\"'\"/>")));
        assert_eq!(exceeded(&spread), None);
        with_root(Path::new("spread.xml"), &spread, |_| Ok(())).unwrap();
        let unclosed = format!("<r {}", many(300_000, |i| format!(" a{i}=''")));
        assert_eq!(exceeded(&unclosed), Some(Limit::Attributes));
    }

    #[test]
    fn namespaces_of_a_document_are_counted() {
        let within = many(200, |i| format!(" xmlns:n{i}='u{i}'"));
        let spread = |n| format!("<r>{}</r>", many(n, |i| format!("<x xmlns:n='u{i}'/>")));
        assert_eq!(exceeded(&format!("<r {within}/>")), None);
        assert_eq!(exceeded(&format!("<r {within}><x {within}/></r>")), Some(Limit::Namespaces));
        assert_eq!(
            (exceeded(&spread(256)), exceeded(&spread(257))),
            (None, Some(Limit::Namespaces))
        );
    }
}
