//! A line of Table 1: savings by measures I, II and III.

use crate::errata::COLUMN_III;
use crate::{Check, Row};

/// Figures that the publication prints of an algorithm.
#[derive(Clone, Copy, Debug)]
pub struct Printed {
    /// Measure I: part of the work for both views that is saved, in per cent.
    pub i: f64,
    /// Measure II: part of the second view's work that is saved, in per cent.
    pub ii: f64,
    /// Measure III: speed-up. It is printed as 1 + II.
    pub iii: f64,
    /// Measure III by its own definition, 1/(1 − I).
    pub corrected: f64,
    /// I and II are printed as "<1 %".
    pub less: bool,
}

impl Printed {
    /// A line with its percentages, its speed-up, and what the speed-up should be.
    pub const fn new(i: f64, ii: f64, iii: f64, corrected: f64) -> Printed {
        Printed { i, ii, iii, corrected, less: false }
    }

    /// A line that prints "<1 %".
    pub const fn less_than_1() -> Printed {
        Printed { i: 1.0, ii: 1.0, iii: 1.0, corrected: 1.0, less: true }
    }

    /// Its three rows for a part of the work, or of the time, that is saved here.
    pub fn rows(&self, what: &str, saving: f64, checks: [Check; 3]) -> [Row; 3] {
        let percent = |measure: &str, printed: f64, here: f64, check: Check| {
            let digits = usize::from(printed.fract() != 0.0);
            let row = Row::new(format!("{what}, {measure}"), 100.0 * here, digits, check).unit("%");
            if self.less {
                row.printed_less(printed)
            } else {
                row.printed(printed)
            }
        };
        [
            percent("I", self.i, saving, checks[0]),
            percent("II", self.ii, 2.0 * saving, checks[1]),
            self.speed_up(format!("{what}, III"), 1.0 / (1.0 - saving), checks[2]),
        ]
    }

    /// The row of measure III alone.
    pub fn speed_up(&self, what: impl Into<String>, ratio: f64, check: Check) -> Row {
        let row = Row::new(what, ratio, 2, check).printed(self.iii);
        if self.corrected == self.iii {
            row
        } else {
            row.corrected(self.corrected, COLUMN_III)
        }
    }
}

/// Its lines.
pub const PROJECTION: Printed = Printed::new(33.0, 67.0, 1.67, 1.5);
/// "Flat Shaded Polygon", the greater end of the range; the smaller one is "<1 %".
pub const FLAT: Printed = Printed::new(25.0, 50.0, 1.5, 1.33);
/// "Gouraud Shaded Polygon", both ends of the range.
pub const GOURAUD: [Printed; 2] =
    [Printed::new(4.5, 9.0, 1.1, 1.05), Printed::new(37.5, 75.0, 1.75, 1.6)];
pub const LINES: Printed = Printed::new(25.0, 50.0, 1.5, 1.33);
pub const POLYGONS: Printed = Printed::less_than_1();
pub const FACES: Printed = Printed::new(33.0, 67.0, 1.67, 1.5);
pub const BSP: Printed = Printed::new(17.0, 33.0, 1.33, 1.2);
pub const SCAN_LINE: Printed = Printed::new(12.0, 24.0, 1.24, 1.14);
pub const VILLAGE: Printed = Printed::new(18.8, 37.6, 1.38, 1.23);
