//! The properties in the text of a module.

/// A property: an assertion whose label begins with `p_`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its label without `p_`.
    pub name: String,
    /// The sentence before it.
    pub sentence: String,
}

/// The properties of a module, in their order. What else is asserted are lemmas.
pub fn properties(text: &str) -> Vec<Property> {
    let Some((_, formal)) = text.split_once("`ifdef FORMAL") else { return Vec::new() };
    let mut properties = Vec::new();
    let mut sentence: Vec<&str> = Vec::new();
    for line in formal.lines().map(str::trim) {
        if let Some(comment) = line.strip_prefix("// ") {
            sentence.push(comment);
            continue;
        }
        let label = line.split_once(": assert").map(|(before, _)| before.rsplit(' ').next());
        if let Some(name) = label.flatten().and_then(|label| label.strip_prefix("p_")) {
            properties.push(Property { name: name.to_owned(), sentence: sentence.join(" ") });
        }
        sentence.clear();
    }
    properties
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn properties_have_labels_and_sentences() {
        let text =
            "module m;\n// No.\np_no: assert (0);\n`ifdef FORMAL\n// Yes,\n    // all.\n    \
                    p_yes: assert (\n1);\nlemma: assert (1);\nalways @* p_too: assert (1);\n`endif";
        let [yes, too] = &properties(text)[..] else { panic!("two") };
        assert_eq!((&yes.name[..], &yes.sentence[..]), ("yes", "Yes, all."));
        assert_eq!((&too.name[..], &too.sentence[..]), ("too", ""));
    }
}
