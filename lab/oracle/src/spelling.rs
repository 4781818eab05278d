//! What a name that nothing has is meant for.

/// The known name that is nearly this one; a capital is as good as a small letter, and `-` as `_`.
pub fn near(name: &str, known: impl IntoIterator<Item = String>) -> Option<String> {
    let plain = |name: &str| name.to_lowercase().replace(['-', ' '], "_");
    let likeness = |known: &String| strsim::jaro_winkler(&plain(known), &plain(name));
    let names = known.into_iter().filter(|known| likeness(known) > 0.8);
    names.max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
}
