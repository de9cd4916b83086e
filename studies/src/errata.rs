//! Errata that figures show. Each begins with its short name in `docs/errata.md`, which tells them at
//! length.

// McCann & Lister.
pub(crate) const GATES: &str = "Gates: the column of table 1 sums to 22,754, not to about 30,000";
pub(crate) const MEAN_ERROR: &str = "Mean error: the printed mean leaves out n = 1, which is exact";

// Adelson et al.
pub(crate) const COLUMN_III: &str =
    "Column III: printed is 1 + II; by its own definition it is 1/(1 − I)";
pub(crate) const TOWER: &str =
    "Tower: 862 and 775 follow from 29 edge pixels; the tower has 58, which save 15.9 %";
pub(crate) const FLAT_TRIANGLE: &str = "4.5 %: 1442 to 1376 is a saving of 4.58 %";

// Heo, Jung and Wohn.
pub(crate) const COPIES: &str = "Copies of a room: n rooms of 3,652 polygons have n × 3,652";
pub(crate) const FIFTEEN_THOUSAND: &str =
    "15,000 polygons: by table 1 both views take the same time at 14,155";

// NASA.
pub(crate) const WIDTH: &str =
    "Width: the table follows from its field of 40 degrees, not from a screen 12.4 in wide";
pub(crate) const WHOLE_DEGREES: &str =
    "Whole degrees: the zero after the point is none of the figure's";
pub(crate) const ROW_4: &str = "Row 4: its signs are plus; the scan shows minus";
pub(crate) const SUBTRACT: &str =
    "Subtract: with SI = SD the denominator is d' + MAXD − SD, not + SD";
pub(crate) const SIMILAR_TRIANGLES: &str = "Similar triangles: they give NCP/POT, not NCP/FCP";
pub(crate) const LINEAR: &str =
    "Linear: 1/d is affine in 1/d'; d is linear only where FCP·MIND = NCP·MAXD";

// Duvanenko & Robbins.
pub(crate) const TRIANGLES: &str = "Triangles: 200 samples in a row have 199 cells between them";
pub(crate) const WHICH_EYE: &str =
    "Which eye: Listing One moves the scene to the left for the left eye: it is seen by the right";
pub(crate) const DEPTH: &str =
    "Depth: Listing One's matrix makes z/w one constant; 1/(−z) is kept here";
