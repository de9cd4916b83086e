//! Numbers for people: thousands apart, things in the singular where there is one.

use wheatstone_golden::text::Grouped;

/// A count of things, in the singular where it is one.
pub(crate) fn counted(n: u64, thing: &str) -> String {
    format!("{} {thing}{}", Grouped(n), if n == 1 { "" } else { "s" })
}

/// A number of at least 0, rounded, with its thousands apart.
pub(crate) fn thousands(value: f64) -> String {
    Grouped(value.round_ties_even() as u64).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        let counts = [0, 1, 2, 12_345].map(|n| counted(n, "beat"));
        assert_eq!(counts, ["0 beats", "1 beat", "2 beats", "12,345 beats"]);
    }

    #[test]
    fn numbers_have_commas() {
        assert_eq!([5.0, 999.0, 1000.0, 22754.0].map(thousands), ["5", "999", "1,000", "22,754"]);
    }
}
