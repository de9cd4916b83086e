//! The properties in the text of a module.

use crate::sources::FORMAL;

/// A property: an assertion whose label begins with `p_`, or several whose labels end in `__` and a
/// number, for parts that are easier proved alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its label without `p_` and number.
    pub name: String,
    /// The sentence before it.
    pub sentence: String,
}

/// The properties of a module, in their order. What else is asserted are lemmas.
pub fn properties(text: &str) -> Vec<Property> {
    let Some((_, formal)) = text.split_once(FORMAL) else { return Vec::new() };
    let mut properties = Vec::new();
    let mut sentence: Vec<&str> = Vec::new();
    for line in formal.lines().map(str::trim) {
        if let Some(comment) = line.strip_prefix("// ") {
            sentence.push(comment);
            continue;
        }
        let label = line.split_once(": assert").map(|(before, _)| before.rsplit(' ').next());
        if let Some(name) = label.flatten().and_then(name) {
            let is_part = properties.last().is_some_and(|last: &Property| last.name == name);
            if !is_part {
                properties.push(Property { name: name.to_owned(), sentence: sentence.join(" ") });
            }
        }
        sentence.clear();
    }
    properties
}

/// The property that a label is of, whatever block it is in; none of a lemma.
pub fn name(label: &str) -> Option<&str> {
    let label = label.rsplit('.').next()?.strip_prefix("p_")?;
    Some(label.split_once("__").map_or(label, |(name, _)| name))
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
        let parts = "`ifdef FORMAL\n// Of all.\np_a__0: assert (1);\np_a__1: assert (1);";
        assert_eq!(properties(parts).len(), 1);
        assert_eq!((name("g.p_a__1"), name("lemma")), (Some("a"), None));
    }
}
