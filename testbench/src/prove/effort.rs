//! The effort that the proof of a module is worth.

use std::time::Duration;

/// Processor time after which a prover is stopped.
pub const LIMIT: Duration = Duration::from_secs(60);

/// The part of [`LIMIT`] that a prover may need in the short set: what needs more would not be proved on
/// a machine whose processor happens to be slow.
pub const SHORT: Duration = LIMIT.checked_div(5).unwrap();

/// The clocks that a proof covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Clocks of induction that are tried.
    pub induction: u32,
    /// Clocks from reset where that does not close.
    pub bound: u32,
    /// Labels of properties that are then tried by themselves, and for how many clocks.
    deep: &'static [(&'static str, u32)],
    /// Labels of properties that are not proved.
    pub(super) left_out: &'static [&'static str],
}

impl Effort {
    /// The effort that a module is worth.
    pub fn of(module: &str) -> Effort {
        let [induction, bound] = match module {
            // Without registers one clock is all there is.
            "clamp" | "popcount" | "setup_check" | "coverage" | "coverage_edge"
            | "filter_division" => [1, 1],
            "primary_planes" | "hybrid_planes" => [1, 5],
            "hybrid" | "stereo" | "mono" | "hybrid_back" => [2, 12],
            "slot_queue" => [2, 10],
            "minimal" => [2, 10],
            "primary" => [2, 14],
            _ => [3, 10],
        };
        let deep: &[(&str, u32)] = match module {
            "hybrid" | "stereo" | "mono" | "hybrid_back" => &DEEP,
            // It takes 30 beats to count too many.
            "filter" => &[("p_range", 33)],
            _ => &[],
        };
        Effort { induction, bound, deep, left_out: &[] }
    }

    /// The effort that a default test can afford for a module's first build: no prover needs more than
    /// [`SHORT`]. None of modules that are not in the short set.
    pub fn quick(module: &str) -> Option<Effort> {
        if ["coverage_edge", "primary_planes", "hybrid_planes"].contains(&module) {
            return None;
        }
        let left_out = Effort::left_out_of_short(module);
        let effort = Effort::of(module);
        Some(Effort { bound: effort.bound.min(4), deep: &[], left_out, ..effort })
    }

    /// Labels of a module's properties that need more than [`SHORT`].
    pub(super) fn left_out_of_short(module: &str) -> &'static [&'static str] {
        match module {
            "blend" => &["p_between"],
            _ => &[],
        }
    }

    /// True if it is that of a module for which one clock is all there is.
    pub(super) fn has_no_registers(self) -> bool {
        self.bound == 1
    }

    /// The clocks that a property is tried for in the end.
    pub(super) fn clocks(&self, label: &str) -> u32 {
        let deep = self.deep.iter().find(|(deep, _)| *deep == label);
        deep.map_or(self.bound, |(_, clocks)| *clocks)
    }
}

/// Properties of systems that show after more clocks, when each of them is tried by itself.
const DEEP: [(&str, u32); 5] = [
    ("p_never_hangs", 30),
    ("p_left_stable", 18),
    ("p_right_stable", 18),
    ("p_request_stable", 18),
    ("p_stable", 18),
];
