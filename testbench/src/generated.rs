//! Files of the workspace that are generated, whole or between marks: the header of the Verilog, and
//! tables in the pages of `docs/`.

use crate::baseline::{area_table, row_tables, Areas, Recorded};
use crate::mutation::record::Scores;
use crate::prove::record;
use crate::record::RecordError;
use crate::settings::{SettingError, Settings};
use crate::synth::record::Record;
use crate::verification;
use std::fmt::Write;
use std::path::Path;
use thiserror::Error;
use wheatstone_golden::config::Config;
use wheatstone_golden::document::interface_tables;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::header::formats_header;
use wheatstone_golden::quality::Quality;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::scene::{self, SceneError};
use wheatstone_golden::setup::{Options, Plan, Planner, Row};
use wheatstone_golden::targets::Target;

/// A file that is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Generated {
    /// `rtl/sam_formats.vh`.
    Header,
    /// The page of a unit or system: its interface and what it costs.
    Page(Target),
    /// `docs/formal.md`: what is proved.
    Formal,
    /// `docs/cost.md`: gates, LUTs and clocks of all targets.
    Cost,
    /// `docs/mutation.md`: the scores.
    Mutation,
    /// `docs/theory.md`: how many polygons are derived, how far pictures are from direct rendering.
    Theory,
    /// `docs/verification.md`: what is covered, which packs replay where.
    Verification,
}

/// A file could not be generated.
#[derive(Debug, Error)]
pub enum GenerateError {
    /// A page has no place for its table.
    #[error("{path}: no line {begin} with a line {END} after it")]
    Marks {
        /// The page.
        path: String,
        /// The first mark.
        begin: String,
    },
    /// A picture of the theory page asks for what there is not.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A scene of the theory page cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A record cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
}

/// Line after a generated part of a page.
const END: &str = "<!-- end -->";

impl Generated {
    /// All generated files.
    pub fn all() -> impl Iterator<Item = Generated> {
        let pages = Target::ALL.into_iter().map(Generated::Page);
        let rest = [
            Generated::Formal,
            Generated::Cost,
            Generated::Mutation,
            Generated::Theory,
            Generated::Verification,
        ];
        [Generated::Header].into_iter().chain(pages).chain(rest)
    }

    /// Path below the workspace.
    pub fn path(self) -> String {
        match self {
            Generated::Header => "rtl/sam_formats.vh".into(),
            Generated::Page(target) => format!("docs/{}.md", target.name()),
            Generated::Formal => "docs/formal.md".into(),
            Generated::Cost => "docs/cost.md".into(),
            Generated::Mutation => "docs/mutation.md".into(),
            Generated::Theory => "docs/theory.md".into(),
            Generated::Verification => "docs/verification.md".into(),
        }
    }

    /// The text that the file should have, given the one that it has, in a workspace.
    pub fn renewed(self, present: &str, workspace: &Path) -> Result<String, GenerateError> {
        match self {
            Generated::Header => Ok(formats_header()),
            Generated::Page(target) => {
                let text = self.between(present, "interface", &interface_tables(target))?;
                let record = Record::read(workspace)?;
                let text = self.between(&text, "synthesis", &record.page_table(target))?;
                match target {
                    Target::Stereo => self.between(&text, "baseline", &baseline_tables(workspace)?),
                    _ => Ok(text),
                }
            }
            Generated::Formal => {
                let record = record::Record::read(workspace)?;
                let text = self.between(present, "proofs", &record.tables(workspace))?;
                let text = self.between(&text, "time", &record.time())?;
                self.between(&text, "netlists", &record.netlist_table())
            }
            Generated::Cost => {
                self.between(present, "synthesis", &Record::read(workspace)?.overview())
            }
            Generated::Mutation => {
                self.between(present, "scores", &Scores::read(workspace)?.table())
            }
            Generated::Theory => {
                let text = self.between(present, "cost", &cost_table())?;
                self.between(&text, "quality", &quality_table(workspace)?)
            }
            Generated::Verification => {
                let record = verification::Record::read(workspace)?;
                let text = self.between(present, "coverage", &record.coverage_table())?;
                let text = self.between(&text, "crossing", &record.crossing_table())?;
                self.between(&text, "replay", &record.replay_table())
            }
        }
    }

    fn between(self, present: &str, name: &str, table: &str) -> Result<String, GenerateError> {
        let begin = format!("<!-- generated: {name} -->");
        let parts = present.split_once(&begin).and_then(|(before, rest)| {
            let (_, after) = rest.split_once(END)?;
            Some(format!("{before}{begin}\n{table}{END}{after}"))
        });
        parts.ok_or_else(|| GenerateError::Marks { path: self.path(), begin })
    }
}

fn baseline_tables(workspace: &Path) -> Result<String, RecordError> {
    let mut areas = Vec::new();
    for config in Config::NAMES {
        areas.extend(Areas::recorded(workspace, config)?.map(|a| (config, a)));
    }
    let recorded = Recorded::read(workspace)?;
    let rows = areas.iter().filter_map(|(config, areas)| {
        Some(row_tables(recorded.0.get(*config)?, config, Some(areas)))
    });
    Ok(area_table(&areas) + &rows.collect::<String>())
}

/// Random triangles of each class in the table of costs, and the views they are drawn in.
const TRIANGLES: usize = 10_000;
const VIEW: [u32; 2] = [160, 120];

fn cost_table() -> String {
    let mut table = String::from(
        "\n| class | drawn | derived | with the cost rule | beats a covered pixel |\n| --- | --- | --- | --- | --- |\n",
    );
    let config = Config { antialias: false, tilt: false, ..Config::FULL };
    let planner = |cost_rule| {
        let options = Options { cost_rule, ..Options::new(&config) };
        Planner::new(config, options, VIEW[0], VIEW[1])
    };
    let [free, ruled] = [planner(false), planner(true)];
    for class in Class::ALL {
        let mut triangles = Triangles::new(class as u64 + 77, free.formats, VIEW[0], VIEW[1]);
        let (mut drawn, mut derived, mut with_rule, mut beats, mut covered) = (0, 0, 0, 0, 0);
        for _ in 0..TRIANGLES {
            let polygon = triangles.triangle(class);
            drawn += u32::from(!matches!(free.plan(&polygon), Plan::Nothing));
            with_rule += u32::from(matches!(ruled.plan(&polygon), Plan::Derived(_)));
            let Plan::Derived(plan) = free.plan(&polygon) else { continue };
            derived += 1;
            beats += plan.rows.iter().map(Row::len).sum::<u64>();
            let spans = plan.primary_view.monocular_spans(VIEW[0]);
            let rows = plan.primary_view.rows(&spans, VIEW[1]);
            covered += rows.map(|row| row.len()).sum::<u64>();
        }
        let share = |n: u32| 100.0 * f64::from(n) / f64::from(drawn);
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| {} | {drawn} | {:.1} % | {:.1} % | {:.2} |",
            class.name(),
            share(derived),
            share(with_rule),
            beats as f64 / covered as f64
        );
    }
    table
}

/// Options of the renderings for the theory page, as of `wheatstone render`.
const RENDERED: [&str; 26] = [
    "--scene teapot",
    "--scene teapot --param cost_rule=off",
    "--scene teapot --param specular=approximation",
    "--scene teapot --param integrated=on",
    "--scene teapot --param integrated=on --param cost_rule=off",
    "--scene teapot --param depth=sampled",
    "--scene teapot --config paper",
    "--scene teapot --config full",
    "--scene ramp --param cost_rule=off",
    "--scene ties --param cost_rule=off",
    "--scene slivers",
    "--scene slivers --param cost_rule=off",
    "--scene slivers --param cost_rule=off --param integrated=on",
    "--scene ratio --param cost_rule=off",
    "--scene ratio --param cost_rule=off --param sampling=average",
    "--scene ratio --param cost_rule=off --param sampling=average --param filter=3",
    "--scene ratio --param cost_rule=off --param sampling=average --param filter=2",
    "--scene room",
    "--scene room --param texture=bilinear",
    "--scene room --config full",
    "--scene teapot --method minimal",
    "--scene ratio --method minimal",
    "--scene slivers --param cost_rule=off --method minimal",
    "--scene teapot --config full --rig docs/figures/tilt.json",
    "--scene ramp --config full --rig docs/figures/tilt.json",
    "--scene teapot --method minimal --param tilt=on --rig docs/figures/tilt.json",
];

fn quality_table(workspace: &Path) -> Result<String, GenerateError> {
    let mut table = String::from(
        "\n| `wheatstone render --out DIR` … | left | right | other ids | gaps |\n| --- | --- | --- | --- | --- |\n",
    );
    for options in RENDERED {
        let [left, right] = rendered(options, workspace)?;
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| `{options}` | {} | {} | {}, {} | {}, {} |",
            left.ratio(),
            right.ratio(),
            left.ids,
            right.ids,
            left.gaps,
            right.gaps
        );
    }
    Ok(table)
}

fn rendered(options: &str, workspace: &Path) -> Result<[Quality; 2], GenerateError> {
    let (mut name, mut config, mut rig, mut minimal) = ("teapot", "default", None, false);
    let mut parameters = Vec::new();
    let words: Vec<&str> = options.split(' ').collect();
    for pair in words.chunks(2) {
        match *pair {
            ["--scene", value] => name = value,
            ["--config", value] => config = value,
            ["--param", value] => parameters.push(value),
            ["--rig", value] => rig = Some(workspace.join(value)),
            ["--method", value] => minimal = value == "minimal",
            _ => unreachable!("{options}"),
        }
    }
    let settings = Settings::new(config, &parameters)?;
    let scene = scene::open(name, None, rig.as_deref())?;
    let formats = Formats::new(&settings.config);
    let geometry = scene.geometry(&formats, &scene::Options::default())?;
    let job = settings.job(&geometry);
    let (direct, (frames, _)) = (job.direct(), job.derived(minimal));
    Ok(Eye::BOTH
        .map(|eye| Quality::of(&job, eye, &frames.eyes[eye as usize], &direct[eye as usize])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_marked_part_of_a_page_is_renewed() {
        let page = Generated::Page(Target::Blend);
        let workspace = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let renewed = |text: &str| page.renewed(text, workspace);
        let part = |name| format!("<!-- generated: {name} -->\nold\n<!-- end -->\n");
        let text = renewed(&format!("above\n{}{}below\n", part("interface"), part("synthesis")));
        let text = text.unwrap();
        assert!(text.starts_with("above\n") && text.ends_with("\nbelow\n"));
        assert!(!text.contains("old") && text.contains("| `pixel` | in |"));
        assert!(text.contains("4,520 gates"));
        assert_eq!(renewed(&text).unwrap(), text);
        let error = renewed("nothing").unwrap_err();
        assert!(error.to_string().starts_with("docs/blend.md: no line <!-- generated"));
    }
}
