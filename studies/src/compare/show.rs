//! Results of the methods, as a table and as JSON.

use super::{Measured, Method, Outcome};
use serde_json::{json, Value};
use wheatstone_golden::primary::Counts;
use wheatstone_golden::quality::Quality;
use wheatstone_golden::text::Grouped;

/// The outcomes as a table; a dash stands for what a method does not count.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::UTF8_BORDERS_ONLY);
    table.set_content_arrangement(comfy_table::ContentArrangement::Disabled);
    table.set_header([
        "",
        "operations",
        "pixels",
        "beats",
        "time",
        "views",
        "wrong polygon",
        "ties",
        "wrong colour",
        "holes",
        "PSNR",
    ]);
    let mut notes = String::new();
    for Outcome { method, result } in outcomes {
        let mut row = vec![method.name.to_string()];
        match result {
            Err(unsuited) => {
                row.push("unsuited".into());
                notes += &format!("\n{}: {unsuited}", method.name);
            }
            Ok(measured) => {
                row.extend(cells(method, measured));
                if let Some(preparation) = measured.preparation {
                    let sum = measured.time.ratio + preparation;
                    notes += &format!(
                        "\n{}: making the tree takes {preparation:.2} more, {sum:.2} together",
                        method.name
                    );
                }
                if let Some(counts) = &measured.counts {
                    notes += &format!("\n{}: {}", method.name, derived(counts));
                }
            }
        }
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(comfy_table::CellAlignment::Right);
    }
    format!("{table}{notes}")
}

/// Number of polygons that were derived, and the reasons why the others were not.
fn derived(counts: &Counts) -> String {
    let number = |n: u64| Grouped(n).to_string();
    let mut why: Vec<String> =
        counts.monocular.iter().map(|(reason, n)| number(*n) + " " + reason.name()).collect();
    if counts.nothing > 0 {
        why.push(number(counts.nothing) + " covering nothing");
    }
    let why = if why.is_empty() { "none".into() } else { why.join(", ") };
    format!("derived {} of {}; not derived: {why}", number(counts.derived), number(counts.polygons))
}

/// The same as JSON.
fn derived_json(counts: &Counts) -> Value {
    let reasons = counts.monocular.iter().map(|(reason, n)| (reason.name().into(), json!(n)));
    json!({
        "polygons": counts.polygons,
        "derived": counts.derived,
        "monocular": Value::Object(reasons.collect()),
        "nothing": counts.nothing,
    })
}

fn cells(method: &Method, measured: &Measured) -> [String; 10] {
    let Measured { work, time, quality, .. } = measured;
    let counted = |n: u64| if n == 0 { "–".into() } else { Grouped(n).to_string() };
    let number = |n: usize| Grouped(n as u64).to_string();
    let share = |n: usize| {
        format!("{} ({:.2} %)", number(n), 100.0 * n as f64 / quality.pixels.max(1) as f64)
    };
    [
        counted(work.arithmetic().all()),
        counted(work.pixels()),
        counted(work.beats),
        time.to_string(),
        method.judged.name().into(),
        share(quality.ids - quality.ties),
        number(quality.ties),
        share(quality.colours),
        number(quality.gaps),
        quality.ratio(),
    ]
}

/// Counts with `null` for what a method does not count.
fn counts(work: Value) -> Value {
    match work {
        Value::Object(fields) => fields.into_iter().map(|(k, v)| (k, counts(v))).collect(),
        Value::Number(n) if n.as_u64() == Some(0) => Value::Null,
        other => other,
    }
}

/// A view, or both together, as JSON.
fn quality_json(quality: &Quality) -> Value {
    json!({
        "pixels": quality.pixels,
        "wrong_polygon": quality.ids - quality.ties,
        "ties": quality.ties,
        "wrong_colour": quality.colours,
        "holes": quality.gaps,
        "identical": quality.decibels.is_infinite(),
        "psnr_db": quality.decibels.is_finite().then_some(quality.decibels),
    })
}

/// The outcomes as JSON.
pub fn json(outcomes: &[Outcome]) -> Value {
    let one = |Outcome { method, result }: &Outcome| match result {
        Err(unsuited) => json!({ "method": method.name, "unsuited": unsuited.to_string() }),
        Ok(Measured { work, counts: drawn, time, preparation, views, file, .. }) => json!({
            "method": method.name,
            "operations": counts(json!(work.arithmetic())),
            "work": counts(json!(work)),
            "derivation": drawn.as_ref().map(derived_json),
            "time_ratio": time.ratio,
            "time_noise": time.noise,
            "time_measured": time.is_measured(),
            "preparation_time_ratio": preparation,
            "time_ratio_with_preparation": preparation.map(|preparation| time.ratio + preparation),
            "judged": method.judged.name(),
            "left": quality_json(&views[0]),
            "right": quality_json(&views[1]),
            "both": quality_json(&Quality::together(*views)),
            "file": file,
        }),
    };
    outcomes.iter().map(one).collect()
}
