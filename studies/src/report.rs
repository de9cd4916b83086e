//! Tables of three columns: what is printed, what is correct, what comes out here.

use comfy_table::{presets, ContentArrangement};
use serde::Serialize;
use serde_json::{json, Value};
use std::fmt;
use std::path::PathBuf;

/// Results of an experiment.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Name of the experiment.
    pub experiment: String,
    /// Publication it belongs to.
    pub publication: String,
    /// Its tables.
    pub tables: Vec<Table>,
    /// Pictures and plots that were written.
    pub files: Vec<PathBuf>,
}

/// One table, or the figures that belong together.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Title, with the place in the publication.
    pub title: String,
    /// Its rows.
    pub rows: Vec<Row>,
}

/// One figure.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The measured quantity.
    pub what: String,
    /// Unit of all three numbers; empty for counts and ratios.
    pub unit: String,
    /// As the publication prints it.
    pub printed: Option<f64>,
    /// The printed figure is an upper bound, as in "<1 %".
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub printed_less: bool,
    /// As it should have printed it; the printed one if there is no erratum.
    pub corrected: Option<f64>,
    /// As it comes out here; not a number where it is quoted only.
    pub here: f64,
    /// The value found is less than `here`, by an unknown amount.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub here_less: bool,
    /// Digits after the point to show.
    pub digits: usize,
    /// Requirement on `here`.
    pub check: Check,
    /// The reason why `corrected` differs from `printed`: the erratum's short name in `docs/errata.md`, a colon and
    /// what it says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub erratum: Option<&'static str>,
    /// Remark: the origin of a limit, the reason why the figure is not judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<&'static str>,
}

/// Requirement on a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// The reference to all its digits shown.
    Digits,
    /// The reference within this part of it.
    Within(f64),
    /// At least this.
    AtLeast(f64),
    /// At most this.
    AtMost(f64),
    /// Nothing: it depends on the machine, and is shown as a trend.
    Trend,
}

/// Result of the check of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It does.
    Holds,
    /// It does not.
    Differs,
    /// It is not judged.
    Trend,
    /// It is printed, and not computed here.
    Quoted,
}

impl Row {
    /// A figure without a printed counterpart.
    pub fn new(what: impl Into<String>, here: f64, digits: usize, check: Check) -> Row {
        Row {
            what: what.into(),
            unit: String::new(),
            printed: None,
            printed_less: false,
            corrected: None,
            here,
            here_less: false,
            digits,
            check,
            erratum: None,
            note: None,
        }
    }

    /// A printed figure that is not computed, but others are with it.
    pub fn quoted(what: impl Into<String>, printed: f64) -> Row {
        Row::new(what, f64::NAN, 0, Check::Trend).printed(printed)
    }

    /// A printed figure without an erratum.
    pub fn printed(mut self, printed: f64) -> Row {
        (self.printed, self.corrected) = (Some(printed), Some(printed));
        self
    }

    /// A printed upper bound, as "<1".
    pub fn printed_less(self, bound: f64) -> Row {
        Row { printed_less: true, ..self.printed(bound) }
    }

    /// Says whether `here` is an upper bound.
    pub fn here_less(self, less: bool) -> Row {
        Row { here_less: less, ..self }
    }

    /// A figure that is not printed, but follows from what is.
    pub fn expected(mut self, expected: f64) -> Row {
        self.corrected = Some(expected);
        self
    }

    /// A printed figure that should be another.
    pub fn corrected(mut self, corrected: f64, erratum: &'static str) -> Row {
        (self.corrected, self.erratum) = (Some(corrected), Some(erratum));
        self
    }

    /// Names an erratum that the figure shows.
    pub fn because(mut self, erratum: &'static str) -> Row {
        self.erratum = Some(erratum);
        self
    }

    /// Says what else must be known of it.
    pub fn note(mut self, note: &'static str) -> Row {
        self.note = Some(note);
        self
    }

    /// Names the unit.
    pub fn unit(mut self, unit: &str) -> Row {
        self.unit = unit.into();
        self
    }

    /// Result of the check.
    pub fn verdict(&self) -> Verdict {
        let holds = |holds| if holds { Verdict::Holds } else { Verdict::Differs };
        let reference = self.corrected.or(self.printed).unwrap_or(f64::NAN);
        match self.check {
            Check::Digits => holds(
                !self.here.is_nan() && self.text(Some(self.here)) == self.text(Some(reference)),
            ),
            Check::Within(part) => holds((self.here - reference).abs() <= part * reference.abs()),
            Check::AtLeast(least) => holds(self.here >= least),
            Check::AtMost(most) => holds(self.here <= most),
            Check::Trend if self.here.is_nan() => Verdict::Quoted,
            Check::Trend => Verdict::Trend,
        }
    }

    fn text(&self, value: Option<f64>) -> String {
        let value = value.filter(|value| !value.is_nan());
        value.map(|value| format!("{value:.*}", self.digits)).unwrap_or_default()
    }

    fn corrected_less(&self) -> bool {
        self.printed_less && self.corrected == self.printed
    }

    fn held_to(&self) -> String {
        match self.check {
            Check::Digits => "its digits".into(),
            Check::Within(part) => format!("within {} %", 100.0 * part),
            Check::AtLeast(least) => format!("at least {least}"),
            Check::AtMost(most) => format!("at most {most}"),
            Check::Trend => String::new(),
        }
    }
}

impl Report {
    /// All its figures.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.tables.iter().flat_map(|table| &table.rows)
    }

    /// Figures that do not hold.
    pub fn differing(&self) -> impl Iterator<Item = &Row> {
        self.rows().filter(|row| row.verdict() == Verdict::Differs)
    }

    /// The report as JSON, with the verdict of every figure.
    pub fn json(&self) -> Value {
        let row = |row: &Row| {
            let mut value = json!(row);
            value["verdict"] = json!(row.verdict());
            value
        };
        let table = |table: &Table| {
            let rows: Vec<Value> = table.rows.iter().map(row).collect();
            json!({ "title": table.title, "rows": rows })
        };
        json!({
            "experiment": self.experiment,
            "publication": self.publication,
            "tables": self.tables.iter().map(table).collect::<Vec<_>>(),
            "files": self.files,
        })
    }
}

/// The mark before a figure that is an upper bound.
fn less(bound: bool) -> &'static str {
    if bound {
        "<"
    } else {
        ""
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_preset(presets::UTF8_BORDERS_ONLY);
        table.set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(["", "printed", "corrected", "here", "", "held to", ""]);
        let mut footnotes: Vec<&str> = Vec::new();
        let mut mark = |text: Option<&'static str>| {
            text.map_or(String::new(), |text| {
                let found = footnotes.iter().position(|&known| known == text);
                let index = found.unwrap_or_else(|| {
                    footnotes.push(text);
                    footnotes.len() - 1
                });
                format!("[{}]", index + 1)
            })
        };
        for row in &self.rows {
            let [erratum, note] = [mark(row.erratum), mark(row.note)];
            let verdict = match row.verdict() {
                Verdict::Holds => "holds",
                Verdict::Differs => "DIFFERS",
                Verdict::Trend => "trend",
                Verdict::Quoted => "quoted",
            };
            table.add_row([
                row.what.clone(),
                format!("{}{}", less(row.printed_less), row.text(row.printed)),
                format!("{}{}{erratum}", less(row.corrected_less()), row.text(row.corrected)),
                format!("{}{}", less(row.here_less), row.text(Some(row.here))),
                row.unit.clone(),
                row.held_to(),
                format!("{verdict}{note}"),
            ]);
        }
        writeln!(f, "{}", self.title)?;
        if self.rows.is_empty() {
            return Ok(());
        }
        writeln!(f, "{table}")?;
        for (index, footnote) in footnotes.iter().enumerate() {
            writeln!(f, "  [{}] {footnote}", index + 1)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_judged_by_what_they_are_held_to() {
        let row = |here, check| Row::new("x", here, 1, check).printed(2.5).verdict();
        assert_eq!(row(2.54, Check::Digits), Verdict::Holds);
        assert_eq!(row(2.56, Check::Digits), Verdict::Differs);
        assert_eq!(row(2.6, Check::Within(0.05)), Verdict::Holds);
        assert_eq!(row(2.7, Check::Within(0.05)), Verdict::Differs);
        assert_eq!(row(2.7, Check::AtLeast(2.7)), Verdict::Holds);
        assert_eq!(row(2.7, Check::AtMost(2.6)), Verdict::Differs);
        assert_eq!(row(9.0, Check::Trend), Verdict::Trend);
        let less = Row::new("x", 3.0, 0, Check::Trend).printed_less(1.0).here_less(true);
        let text = Table { title: "t".into(), rows: vec![less] }.to_string();
        assert!(text.matches("<1").count() == 2 && text.contains("<3"), "{text}");
        let wrong = Row::new("x", 1.5, 2, Check::Digits).printed(1.67).corrected(1.5, "1 + II");
        assert_eq!(wrong.verdict(), Verdict::Holds);
        let table = Table { title: "t".into(), rows: vec![wrong] }.to_string();
        assert!(table.contains("1.67") && table.contains("[1] 1 + II"), "{table}");
        let quoted = Row::quoted("x", 9.0);
        assert_eq!(quoted.verdict(), Verdict::Quoted);
        let rows = vec![quoted.note("a"), Row::new("y", 1.0, 0, Check::Trend).note("a")];
        let table = Table { title: "t".into(), rows }.to_string();
        assert!(table.contains("quoted[1]") && table.contains("trend[1]"), "{table}");
        assert_eq!(table.matches("  [1] a\n").count(), 1, "{table}");
    }
}
