//! What is read of XML, and what is refused.

use super::*;

/// Names and lines of the children of the root, read one by one.
fn read(text: &str) -> Result<Vec<(String, Option<u32>)>, ReadError> {
    let mut places = Vec::new();
    Document::of(Path::new("f.xml"), text)?.each_child(|child| {
        places.push((child.name().to_owned(), child.error("", "").line));
        Ok(())
    })?;
    Ok(places)
}

#[test]
fn an_error_names_line_element_and_value() {
    let text = "<r>\n <lanelet id=\"7\">\n  <x>1e999</x></lanelet></r>";
    let document = Document::whole(Path::new("f.xml"), text).unwrap();
    let lanelet = document.root().get("lanelet").unwrap();
    let error = lanelet.number_in("x", 0.0, 1.0).unwrap_err();
    assert_eq!((error.line, error.element.as_str()), (Some(3), "r/lanelet[7]/x"));
    assert!(error.message.contains("1e999"), "{error}");
}

#[test]
fn children_are_read_one_by_one_at_their_lines() {
    let text = "<?xml version='1.0'?>\n<r n='&lt;>'\n b='1'><!-- > --><a b='/>'>&#52;<x/>\n</a>\n<![CDATA[</r>]]>\
                <e/></r>\n<!-- end -->\n";
    let places = [("a", 3), ("e", 5)].map(|(name, line)| (name.to_owned(), Some(line)));
    assert_eq!(read(text).unwrap(), places);
    let document = Document::whole(Path::new("f.xml"), text).unwrap();
    assert_eq!(document.root().attribute("n").unwrap(), "<>");
    assert_eq!(document.root().get("a").unwrap().text(), "4");
}

#[test]
fn what_is_no_xml_is_refused() {
    let good = "<r n='1'><x>10</x><last/></r><!-- end -->";
    assert!(read(good).is_ok());
    for (from, to) in [
        ("<x>10</x>", "<x>10</y>"),
        ("<x>10</x>", "<x>10"),
        ("<x>10</x>", "10</x>"),
        ("<last/></r>", "<last/></s>"),
        ("<last/></r>", "<last/>"),
        ("<last/>", "</r><r>"),
        ("<last/>", "<!DOCTYPE r>"),
        ("<last/>", "&nothing;"),
        ("<last/>", "&lt"),
        ("<!-- end -->", "<end/>"),
        ("<!-- end -->", "end"),
        ("<!-- end -->", "<!-- end"),
        ("<r n=", "<r r n="),
        ("n='1'", "n='1' n='1'"),
    ] {
        assert!(read(&good.replacen(from, to, 1)).is_err(), "{to}");
    }
    for text in ["", " ", "text", "<r>", "</r>", "<r/><r/>", "<r"] {
        assert!(read(text).is_err(), "{text}");
    }
    assert_eq!((read("<r/>"), read("<r></r>")), (Ok(vec![]), Ok(vec![])));
}

#[test]
fn depth_and_attributes_have_limits() {
    for text in ["<a>".repeat(1_000_000), "<a b='/>'><!--</a>--><![CDATA[</a>]]>/>".repeat(100_000)]
    {
        let error = read(&text).unwrap_err();
        assert!(error.message.contains("deeper than 64"), "{error}");
    }
    assert!(read(&format!("<r>{}</r>", "<a b='&gt;'/><c></c>".repeat(1000))).is_ok());
    let many = |count: usize| (0..count).map(|i| format!(" a{i}='>'")).collect::<Vec<_>>().concat();
    let of = |count| read(&format!("<r {}/>", many(count)));
    assert!(of(256).is_ok());
    for error in [of(257), of(300_000)].map(Result::unwrap_err) {
        assert!(error.message.contains("more than 256 attributes"), "{error}");
    }
}
