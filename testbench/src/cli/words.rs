//! The words of the command line, repeated in reports.

use clap::ValueEnum;

/// An option with its value, in one word where the value looks like another option.
pub(super) fn option(name: &str, value: impl std::fmt::Display) -> Vec<String> {
    let value = value.to_string();
    match value.starts_with('-') {
        true => vec![format!("{name}={value}")],
        false => vec![name.to_owned(), value],
    }
}

/// An option with names as values, unless it has its default.
pub(super) fn choice<T: ValueEnum + PartialEq>(name: &str, value: T, default: T) -> Vec<String> {
    let named = value.to_possible_value().filter(|_| value != default);
    named.map_or(Vec::new(), |value| option(name, value.get_name()))
}

/// The command line, for reports.
pub(super) fn called() -> String {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, PartialEq, ValueEnum)]
    enum Side {
        Front,
        Back,
    }

    #[test]
    fn options_are_told_as_they_are_read() {
        assert_eq!(option("--scene", "a b.obj"), ["--scene", "a b.obj"]);
        assert_eq!(option("--out", "-x"), ["--out=-x"]);
        assert_eq!(choice("--cull", Side::Back, Side::Front), ["--cull", "back"]);
        assert!(choice("--cull", Side::Front, Side::Front).is_empty());
    }
}
