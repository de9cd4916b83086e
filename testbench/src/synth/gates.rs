//! Gate counts: mapped to standard cells, area over that of a two-input NAND.

use super::design::Design;
use super::tech::{Figure, Figures};
use crate::flow::{FlowError, Folder};
use crate::tools::{self, YOSYS};
use wheatstone_golden::files;

/// A library of cells.
struct Library {
    figure: Figure,
    /// Name of the Liberty file in the working folder.
    file: &'static str,
    /// The cell that counts as one gate.
    nand2: &'static str,
    /// Options of the mapper.
    mapping: &'static str,
}

const LIBRARIES: [Library; 2] = [
    Library { figure: Figure::Osu035, file: "osu035.lib", nand2: "NAND2X1", mapping: "" },
    // Its cells have no delays, which the mapper's own script does not survive.
    Library {
        figure: Figure::Primitive,
        file: "primitive.lib",
        nand2: "NAND2",
        mapping: " -script +strash;ifraig;scorr;dc2;dch,-f;map,-a;topo",
    },
];

/// The project's own library.
const PRIMITIVE: &str = include_str!("../../../synth/primitive.lib");

/// Gates in both libraries.
pub(super) fn measure(design: &Design<'_>) -> Result<Figures, FlowError> {
    let yosys = YOSYS.find()?;
    let path = tools::osu035("lib")?;
    let osu035 =
        files::read_own(&path).map_err(|source| FlowError::Read { path: path.clone(), source })?;
    let texts = [&osu035, PRIMITIVE];
    let script = script(design);
    let inputs =
        [yosys.text.as_bytes(), script.as_bytes(), texts[0].as_bytes(), texts[1].as_bytes()];
    design.cached(&inputs, |folder| {
        for (library, text) in LIBRARIES.iter().zip(texts) {
            folder.write(library.file, text.as_bytes())?;
        }
        folder.run(&YOSYS, folder.command(&yosys).args(["-q", "-p", &script]), &[])?;
        let figures = LIBRARIES.iter().zip(texts).map(|(library, text)| {
            let gates = gates(folder, library, text)?;
            Ok((library.figure, gates.round()))
        });
        figures.collect()
    })
}

/// Synthesis once, then mapping to each library.
fn script(design: &Design<'_>) -> String {
    let mut script = design.read_commands();
    script += &format!("synth -flatten -top {}; design -save synthesised", design.module());
    for Library { file, mapping, .. } in LIBRARIES {
        script += &format!(
            "; design -load synthesised; dfflibmap -liberty {file}; abc -liberty {file}{mapping}; \
             opt_clean -purge; tee -q -o {file}.stat stat -liberty {file}"
        );
    }
    script
}

/// The gates that Yosys counted in a library.
fn gates(folder: &Folder, library: &Library, text: &str) -> Result<f64, FlowError> {
    let stat = folder.read(&YOSYS, &format!("{}.stat", library.file))?;
    // A cell that the library does not have would count nothing.
    let known = !stat.contains("is unknown");
    let area = stat.lines().find_map(|line| line.trim().strip_prefix("Chip area for module"));
    let area = area.and_then(|rest| rest.rsplit(':').next()?.trim().parse::<f64>().ok());
    let nand2 = cell_area(text, library.nand2);
    let gates = area.filter(|_| known).zip(nand2).map(|(area, nand2)| area / nand2);
    gates.ok_or_else(|| folder.failed(&YOSYS, &stat))
}

/// The area of a cell of a Liberty file.
fn cell_area(liberty: &str, cell: &str) -> Option<f64> {
    let spaced = liberty.replace("cell (", "cell(");
    let (_, rest) = spaced.split_once(&format!("cell({cell})"))?;
    let (_, rest) = rest.split_once("area :")?;
    rest.split(';').next()?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_read_in_both_spellings() {
        assert_eq!(cell_area(PRIMITIVE, "NAND2"), Some(4.0));
        assert_eq!(cell_area("cell (A) {\narea : 96;\n}", "A"), Some(96.0));
        assert_eq!(cell_area(PRIMITIVE, "NAND3"), None);
    }
}
