//! The committed files about mutants: the scores, with the table that is made of them, and the list of
//! those that were reviewed.

use super::{Fate, Tested};
use crate::record::{read_record, RecordError};
use serde::{Deserialize, Serialize};
use std::fmt::{Display, Write};
use std::path::Path;
use wheatstone_golden::files::{self, WriteError};
use wheatstone_golden::targets::Target;

/// Path of the scores in the workspace.
pub const FILE: &str = "synth/mutation.json";
/// Path of the list of reviewed mutants in the workspace.
pub const REVIEWED_FILE: &str = "synth/mutants_reviewed.json";

/// The least share of mutants that must be killed.
pub const LEAST_SCORE: f64 = 0.95;

/// The score of a target in a configuration.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Score {
    /// The target's name.
    pub target: String,
    /// The configuration, with the parameters that were changed; [`super::golden::CONFIG`] of the model.
    pub config: String,
    /// Seed of the choice of mutants.
    pub seed: u64,
    /// Mutants killed.
    pub killed: usize,
    /// Mutants proved equivalent.
    pub equivalent: usize,
    /// Mutants reviewed and found equivalent.
    pub reviewed: usize,
    /// Mutants left, each with what is known of it.
    pub survivors: Vec<String>,
}

impl Score {
    /// Counts the mutants of a target.
    pub fn new<M: Display>(target: Target, config: &str, seed: u64, tested: &[Tested<M>]) -> Score {
        let mut score = Score {
            target: target.name().into(),
            config: config.into(),
            seed,
            killed: 0,
            equivalent: 0,
            reviewed: 0,
            survivors: Vec::new(),
        };
        for Tested { mutant, fate } in tested {
            match fate {
                Fate::Killed(_) => score.killed += 1,
                Fate::Equivalent => score.equivalent += 1,
                Fate::Reviewed(_) => score.reviewed += 1,
                Fate::Missed => score.survivors.push(format!("{mutant}: some beats show it")),
                Fate::Undecided => score.survivors.push(format!("{mutant}: undecided")),
            }
        }
        score
    }

    /// All mutants.
    pub fn mutants(&self) -> usize {
        self.killed + self.equivalent + self.reviewed + self.survivors.len()
    }

    /// The share of mutants killed, of those that are not equivalent.
    pub fn share(&self) -> f64 {
        self.killed as f64 / (self.killed + self.survivors.len()).max(1) as f64
    }

    /// True if it is high enough.
    pub fn passes(&self) -> bool {
        self.share() >= LEAST_SCORE
    }

    /// The fault of a score that is not high enough. Of systems that are tested only when they are named much cannot be
    /// decided: their score may be low.
    pub fn low(&self) -> Option<String> {
        let least = 100.0 * LEAST_SCORE;
        let counts = Target::named(&self.target).is_none_or(super::is_usual);
        (counts && !self.passes())
            .then(|| format!("{} {}: below {least:.0} %", self.target, self.config))
    }

    /// True if both are of the same target in the same configuration.
    fn is_same(&self, other: &Score) -> bool {
        (&self.target, &self.config) == (&other.target, &other.config)
    }

    /// The counts and the score, as tables show them.
    pub fn cells(&self) -> [String; 6] {
        let left = self.survivors.len();
        let counts = [self.mutants(), self.killed, self.equivalent, self.reviewed, left];
        let [mutants, killed, equivalent, reviewed, survived] = counts.map(|n| n.to_string());
        [mutants, killed, equivalent, reviewed, survived, self.shown()]
    }

    /// The score as tables show it, rounded down: 100 % is all of them.
    fn shown(&self) -> String {
        format!("{:.1} %", (1000.0 * self.share()).floor() / 10.0)
    }
}

/// Headings of [`Score::cells`].
pub const HEADINGS: [&str; 6] =
    ["mutants", "killed", "proved equivalent", "reviewed equivalent", "survived", "score"];

/// All scores, ordered by target.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scores(Vec<Score>);

impl Scores {
    /// The scores of a workspace.
    pub fn read(workspace: &Path) -> Result<Scores, RecordError> {
        read_record(workspace, FILE, "write it with: wheatstone mutate --record")
    }

    /// Writes them, a line each.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let lines = self.0.iter().map(|score| serde_json::to_string(score).unwrap_or_default());
        let text = format!("[\n{}\n]\n", lines.collect::<Vec<_>>().join(",\n"));
        files::write(&workspace.join(FILE), text.as_bytes())
    }

    /// Puts scores in the place of older ones.
    pub fn update(&mut self, scores: &[Score]) {
        self.0.retain(|old| !scores.iter().any(|new| new.is_same(old)));
        self.0.extend_from_slice(scores);
        let place = |score: &Score| Target::ALL.iter().position(|t| t.name() == score.target);
        self.0.sort_by_key(|score| (place(score), score.config.clone()));
    }

    /// Scores that are lower than here, or than [`LEAST_SCORE`], a line each; also those that are not here.
    pub fn faults(&self, scores: &[Score]) -> Vec<String> {
        scores.iter().flat_map(|new| self.worse(new).into_iter().chain(new.low())).collect()
    }

    fn worse(&self, new: &Score) -> Option<String> {
        let what = format!("{} {}", new.target, new.config);
        let Some(old) = self.0.iter().find(|old| old.is_same(new)) else {
            return Some(format!("{what}: not in {FILE}"));
        };
        let tell = || format!("{what}: {}, recorded {}", new.shown(), old.shown());
        // How many are proved equivalent depends on how fast the processor is; how many are killed does not.
        (new.killed < old.killed && new.share() < old.share()).then(tell)
    }

    /// All of them.
    pub fn all(&self) -> &[Score] {
        &self.0
    }

    /// The table of the documentation, and the list of survivors.
    pub fn table(&self) -> String {
        let mut text =
            format!("\n| | configuration | {} |\n|{}\n", HEADINGS.join(" | "), " --- |".repeat(8));
        for score in &self.0 {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "| [{0}]({0}.md) | `{1}` | {2} |",
                score.target,
                score.config,
                score.cells().join(" | ")
            );
        }
        let survivors = self.0.iter().flat_map(|score| {
            score.survivors.iter().map(|survivor| format!("- {}: `{survivor}`\n", score.target))
        });
        text + "\nThe survivors: place in the Verilog, cell, port and bit, change, and what ABC found; of a golden model place and change.\n\n"
            + &survivors.collect::<String>()
    }
}

/// A mutant that somebody has looked at and that no permitted stimulus shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Review {
    /// The target's name.
    pub target: String,
    /// The configuration.
    pub config: String,
    /// The mutant, as it is told.
    pub mutant: String,
    /// The reason why nothing shows it.
    pub reason: String,
}

/// The reviewed mutants.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Reviews(pub Vec<Review>);

impl Reviews {
    /// The reviewed mutants of a workspace.
    pub fn read(workspace: &Path) -> Result<Reviews, RecordError> {
        let remedy =
            "it is written by hand, a list of objects with target, config, mutant and reason";
        read_record(workspace, REVIEWED_FILE, remedy)
    }

    fn of<'a>(&'a self, target: Target, config: &'a str) -> impl Iterator<Item = &'a Review> {
        self.0.iter().filter(move |r| r.target == target.name() && r.config == config)
    }

    /// The reason why nothing shows a mutant, if it is here.
    pub fn reason(&self, target: Target, config: &str, mutant: &impl Display) -> Option<String> {
        let told = mutant.to_string();
        self.of(target, config).find(|r| r.mutant == told).map(|r| r.reason.clone())
    }

    /// Entries of a target that no longer fit: of its usual mutants none is so called, or it is killed, or some
    /// beats show it. One that a faster machine proves in its time fits.
    pub fn stale<'a, M: Display>(
        &'a self,
        target: Target,
        config: &'a str,
        tested: &[Tested<M>],
    ) -> Vec<&'a Review> {
        let fits = |review: &Review| {
            let mut same = tested.iter().filter(|t| t.mutant.to_string() == review.mutant);
            same.any(|t| matches!(t.fate, Fate::Reviewed(_) | Fate::Equivalent))
        };
        self.of(target, config).filter(|review| !fits(review)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Mutant, SEED};
    use super::*;

    fn tested(number: u32, fate: Fate) -> Tested {
        let change = format!("-mode inv -module m -cell c -port Y -portbit {number}");
        Tested { mutant: Mutant { change, place: "m.v:1".into() }, fate }
    }

    #[test]
    fn equivalent_mutants_do_not_count() {
        let killed = (0..95).map(|n| tested(n, Fate::Killed("random".into())));
        let rest = [Fate::Equivalent, Fate::Reviewed("why".into()), Fate::Missed, Fate::Undecided];
        let mut all: Vec<Tested> = killed.chain(rest.map(|fate| tested(0, fate))).collect();
        let score = |all: &[Tested]| Score::new(Target::Display, "default", SEED, all);
        assert_eq!(score(&all).cells(), ["99", "95", "1", "1", "2", "97.9 %"]);
        all.extend((0..4).map(|n| tested(n, Fate::Missed)));
        assert_eq!((score(&all).share(), score(&all).passes()), (95.0 / 101.0, false));
    }

    #[test]
    fn scores_below_the_recorded_ones_are_told() {
        let score = |killed: usize| Score {
            target: "filter".into(),
            config: "paper".into(),
            seed: SEED,
            killed,
            equivalent: 0,
            reviewed: 0,
            survivors: vec![String::new(); 200 - killed],
        };
        let mut scores = Scores::default();
        assert_eq!(scores.faults(&[score(200)]), [format!("filter paper: not in {FILE}")]);
        scores.update(&[score(195)]);
        assert_eq!(scores.faults(&[score(195), score(196)]), [""; 0]);
        assert_eq!(scores.faults(&[score(194)]), ["filter paper: 97.0 %, recorded 97.5 %"]);
        let undecided = Score { survivors: vec![String::new(); 7], ..score(195) };
        assert_eq!(scores.faults(&[undecided]), [""; 0], "as many killed");
        let golden = Score { config: "golden".into(), ..score(200) };
        assert_eq!(scores.faults(&[golden]).len(), 1);
        // Recorded or not, so few are not enough.
        scores.update(&[score(189)]);
        assert_eq!(scores.faults(&[score(189)]), ["filter paper: below 95 %"]);
    }

    #[test]
    fn an_entry_that_no_longer_fits_is_stale() {
        let review = |mutant: &Mutant| Review {
            target: "display".into(),
            config: "default".into(),
            mutant: mutant.to_string(),
            reason: "why".into(),
        };
        let [one, two, gone] = [1, 2, 3].map(|n| tested(n, Fate::Missed).mutant);
        let reviews = Reviews([&one, &two, &gone].map(review).to_vec());
        let reason = |mutant| reviews.reason(Target::Display, "default", mutant);
        assert_eq!(reason(&one).as_deref(), Some("why"));
        assert_eq!(reviews.reason(Target::Display, "paper", &one), None);
        let all = [tested(1, Fate::Reviewed("why".into())), tested(2, Fate::Killed("x".into()))];
        let stale = reviews.stale(Target::Display, "default", &all);
        assert_eq!(stale, [&reviews.0[1], &reviews.0[2]]);
        let proved = [1, 2, 3].map(|number| tested(number, Fate::Equivalent));
        assert!(reviews.stale(Target::Display, "default", &proved).is_empty());
    }
}
