//! The packs that `wheatstone vectors` writes by default notice every rule of the units and systems broken: a bug
//! is planted in the Verilog for each, and the packs of seed 1 must fail on it in Icarus.

use std::path::Path;
use std::sync::Mutex;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases;
use wheatstone_testbench::pack::{self, Checked, Origin};
use wheatstone_testbench::replay::{Replayer, Way};
use wheatstone_testbench::synth::Synthesiser;
use wheatstone_tests::*;

/// Random beats in the packs of systems here. The packs of the default length begin with the same beats, so
/// that what is noticed here is noticed there.
const SHORT: usize = 600;
/// Random beats of the packs of units, as by default.
const BEATS: usize = 4_000;

/// A rule, and a bug that breaks it: a text of a file that occurs once, and another one.
type Rule = (&'static str, &'static str, &'static str, &'static str);

/// The packs of a target, as `wheatstone vectors` writes them.
fn packs(target: Target, configuration: &str, out: &Path) -> Vec<Checked> {
    let mut words = configuration.split(' ');
    let name = words.next().unwrap_or_default();
    let config = settings(name, &words.collect::<Vec<_>>()).config;
    let large = target.is_system() || target == Target::Mono;
    let beats = if large { SHORT } else { BEATS };
    let write = |(suffix, case): (&'static str, cases::Case)| {
        let hash = pack::rtl_hash(&rtl(), target.module()).expect("the Verilog");
        let origin = Origin { config: name.into(), suffix, ..Origin::random(1) };
        let written = pack::write(&case, &origin, &hash, out);
        let folder = written.unwrap_or_else(|error| panic!("{error}")).folder;
        pack::check(&folder).unwrap_or_else(|error| panic!("{error}")).remove(0)
    };
    cases::for_packs(target, &config, 1, beats).into_iter().map(write).collect()
}

/// True if all packs pass on this Verilog.
fn pass(packs: &[Checked], rtl: &Path) -> bool {
    let cache = workspace().join(Synthesiser::CACHE);
    let replayer = Replayer { synthesiser: Synthesiser { rtl: rtl.to_owned(), cache } };
    packs.iter().all(|pack| {
        let replayed = replayer.replay(pack, Way::Icarus);
        replayed.unwrap_or_else(|error| panic!("{error}")).passed
    })
}

/// The packs of a target pass on the Verilog as it is, and not on any of these bugs.
fn notice(target: Target, configuration: &str, rules: &[Rule]) {
    let folder = folder();
    let packs = packs(target, configuration, folder.path());
    assert!(pass(&packs, &rtl()), "{} ({configuration}) as it is", target.name());
    let (next, missed) = (Mutex::new(rules.iter()), Mutex::new(Vec::new()));
    let work = || loop {
        let Some((rule, file, find, replace)) = next.lock().expect("no panic").next() else {
            return;
        };
        let copy = copy_of_rtl();
        plant(copy.path(), file, find, replace);
        if pass(&packs, copy.path()) {
            missed.lock().expect("no panic").push(format!("{rule}: {file}: {find} → {replace}"));
        }
    };
    std::thread::scope(|scope| drop([(); 2].map(|()| scope.spawn(work))));
    let missed = missed.into_inner().expect("no panic");
    let what = format!("{} ({configuration})", target.name());
    assert!(missed.is_empty(), "{what} did not notice\n{}", missed.join("\n"));
}

#[test]
fn interpolators() {
    let x = "sam_x_interpolator.v";
    notice(
        Target::XInterpolator,
        "default",
        &[
            ("STEP adds G1, ROW the row shear", x, "from + by", "from - by"),
            (
                "ROW starts from the saved row start",
                x,
                "back ? saved_q : acc_q",
                "back ? acc_q : saved_q",
            ),
            (
                "move is the carry of the fraction",
                x,
                "sum[F] ^ from[F] ^ by[F]",
                "sum[F] ^ from[F] | by[F]",
            ),
            ("LOAD does not move", x, "moves & ~is_load", "moves | ~is_load"),
            ("only STEP adds G1 = 1.0", x, "~is_row & step_q[F]", "is_row & step_q[F]"),
            ("near below a half", x, "~acc_q[F-1] | (", "~acc_q[F-1] & ("),
            (
                "near excludes equality",
                x,
                "acc_q[F-2:0], 1'b0} < step_q",
                "acc_q[F-2:0], 1'b0} <= step_q",
            ),
            (
                "near takes the whole fraction",
                x,
                "acc_q[F-2:0], 1'b0} < step_q",
                "acc_q[F-2:0], 1'b1} < step_q",
            ),
            ("inside excludes the width", x, "acc_q[X-1:F] < {", "acc_q[X-1:F] <= {"),
            ("a beat leaves when it is last", x, "(last_q | beat_valid_i)", "beat_valid_i"),
        ],
    );
    let y = "sam_y_interpolator.v";
    notice(
        Target::YInterpolator,
        "default",
        &[
            ("ROW adds the step", y, "y_q + step_wide", "y_q - step_wide"),
            ("only ROW changes y", y, "accept & is_row", "accept & ~is_row"),
            ("end where the next op is not STEP", y, "= last_q | ~is_step;", "= last_q | is_step;"),
        ],
    );
    notice(
        Target::YInterpolator,
        "full",
        &[
            (
                "STEP adds the slant, ROW the row",
                y,
                "is_row ? row_q : slant_wide",
                "is_row ? slant_wide : row_q",
            ),
            ("move is the change of v", y, "sum[F] ^ from[F] ^ by[F]", "sum[F] ^ from[F] & by[F]"),
            ("y = start + step·v, twice", y, "y_q + once + twice", "y_q + once - twice"),
            ("a negative step", y, "step_q[2] ? ~{v", "step_q[2] ? {v"),
            ("inside excludes the height", y, "v < {", "v <= {"),
        ],
    );
    let edge = "sam_edge_interpolator.v";
    notice(
        Target::EdgeInterpolator,
        "full",
        &[
            ("E += a", edge, "value_d = from + by + (", "value_d = from - by + ("),
            (
                "LOAD takes the start alone",
                edge,
                "beat_move_i & ~is_load",
                "beat_move_i | ~is_load",
            ),
            ("ROW adds row + move·a", edge, "moves ? row_a_q : row_q", "moves ? row_q : row_a_q"),
            (
                "ROW starts from the saved value",
                edge,
                "back ? saved_q : value_q",
                "back ? value_q : saved_q",
            ),
            ("y_move·b", edge, "(size ^ {BITS{minus}})", "(size | {BITS{minus}})"),
            ("y_move -2", edge, "beat_y_move_i[1] & ~is_load", "beat_y_move_i[1] & is_load"),
        ],
    );
}

#[test]
fn gathering_units() {
    let sampler = "sam_sampler.v";
    notice(
        Target::Sampler,
        "default",
        &[
            ("only a beat with take is a candidate", sampler, "beat_take_i & (", "beat_take_i | ("),
            ("the first, or a near one", sampler, "~hit | beat_near_i", "~hit & beat_near_i"),
            ("forgotten at first", sampler, "hit_q & ~beat_first_i", "hit_q & beat_first_i"),
            ("hit where there was a candidate", sampler, "hit | beat_take_i", "hit & beat_take_i"),
            ("data 0 without", sampler, "else if (~hit)", "else if (hit)"),
            (
                "one beat at the end",
                sampler,
                "beat_valid_i & beat_end_i",
                "beat_valid_i | beat_end_i",
            ),
        ],
    );
    let filter = "sam_filter.v";
    notice(
        Target::Filter,
        "default",
        &[
            ("only with include", filter, "beat_include_i & ~full", "beat_include_i | ~full"),
            ("the count stops at 29", filter, "beat_include_i & ~full", "beat_include_i"),
            ("exact: half of n is added", filter, "so_many[0] & (", "so_many[0] | ("),
            ("n = 0 gives 0", filter, "(so_many == 0) |", "(so_many != 0) |"),
            (
                "first begins anew",
                filter,
                "beat_first_i | (count_q == 0)",
                "beat_first_i | (count_q != 0)",
            ),
            ("exact quotient", "sam_filter_division.v", "{18'd0, sum_i} * {", "{18'd0, sum_i} + {"),
        ],
    );
    let division = "sam_filter_division.v";
    notice(
        Target::Filter,
        "paper",
        &[
            ("two terms: p", division, "+: 4] - p", "+: 4] + p"),
            ("two terms are rounded", division, "{1'b0, sum_i} + {", "{1'b0, sum_i} - {"),
            ("two terms saturate", division, "rounded[7:0] | {", "rounded[7:0] & {"),
            ("255 at most", division, "rounded[7:0] | {8{rounded[8]}}", "rounded[7:0]"),
        ],
    );
    notice(
        Target::Filter,
        "default filter=3",
        &[
            ("three terms: p", division, "= (scaled >> P", "= (scaled << P"),
            ("three terms: q", division, "+ (scaled >> Q", "- (scaled >> Q"),
            ("three terms are rounded", division, "+ {13'd0, 1'b1", "- {13'd0, 1'b1"),
            ("three terms saturate", division, "total[SHIFT +: 8] | {", "total[SHIFT +: 8] & {"),
        ],
    );
}

#[test]
fn units_of_a_pixel() {
    let (coverage, edge) = ("sam_coverage.v", "sam_coverage_edge.v");
    notice(
        Target::Coverage,
        "full",
        &[
            ("AND of the three", coverage, "mask0 & mask1 & mask2", "mask0 & mask1 | mask2"),
            ("centre: all three E >= 0", coverage, "wire centre = ~(", "wire centre = ("),
            ("samples to the right", edge, "plus = a + b", "plus = a - b"),
            ("samples below", edge, "below = here + b", "below = here - b"),
            ("the last row", edge, "sample_12 = below - less", "sample_12 = below + less"),
            ("far from the edge", edge, "huge ? {2{~sign}}", "huge ? {2{sign}}"),
            ("area: the number of ones", "sam_popcount.v", "ones = ones + {", "ones = ones - {"),
        ],
    );
    let blend = "sam_blend.v";
    notice(
        Target::Blend,
        "default",
        &[
            (
                "α' = alpha + (alpha >> 7)",
                blend,
                "{1'b0, pixel_alpha_i} + {",
                "{1'b0, pixel_alpha_i} - {",
            ),
            (
                "area 0 gives t = 0",
                blend,
                "pixel_area_i[0] ? alpha : 9'd0",
                "pixel_area_i[0] ? 9'd0 : alpha",
            ),
            ("S - B", blend, "pixel_rgb_i[8*i +: 8]} - {", "pixel_rgb_i[8*i +: 8]} + {"),
            ("C = B + …", blend, "1'b1} + change_q", "1'b1} - change_q"),
        ],
    );
    notice(
        Target::Blend,
        "paper",
        &[
            ("t is rounded", blend, "pixel_area_i} + 14'd8", "pixel_area_i} - 14'd8"),
            ("t is a product", blend, "{5'd0, alpha} * {", "{5'd0, alpha} + {"),
        ],
    );
    let display = "sam_display.v";
    notice(
        Target::Display,
        "default",
        &[
            ("mirror: width - 1 - x", display, "width_i + ~point_x_i", "width_i - ~point_x_i"),
            (
                "only with mirror",
                display,
                "point_mirror_i ? from_right",
                "~point_mirror_i ? from_right",
            ),
            ("swap exchanges x", display, "point_swap_i ? point_y_i", "~point_swap_i ? point_y_i"),
            (
                "swap exchanges y",
                display,
                "point_swap_i ? column : point_y_i",
                "point_swap_i ? point_y_i : column",
            ),
        ],
    );
    let redirect = "sam_redirect.v";
    notice(
        Target::Redirect,
        "default",
        &[
            (
                "each pixel once",
                redirect,
                "slot_primary_i & ~primary_gone_q",
                "slot_primary_i | ~primary_gone_q",
            ),
            (
                "the primary first",
                redirect,
                "left_ready_i & ~primary_here",
                "left_ready_i | ~primary_here",
            ),
            (
                "to its eye's stream",
                redirect,
                "single_i ? primary_here : ~slot_eye_i",
                "single_i ? primary_here : slot_eye_i",
            ),
            (
                "one display: both to the left",
                redirect,
                "single_i ? primary_here : ~slot_eye_i",
                "~slot_eye_i",
            ),
            (
                "a secondary is the other eye's",
                redirect,
                "eye_i ^ ~right_primary",
                "eye_i & ~right_primary",
            ),
        ],
    );
}

#[test]
fn void_polygons_and_strays() {
    let (check, polygon) = ("sam_setup_check.v", "sam_polygon.v");
    let rules: &[Rule] = &[
        (
            "a mode above 3 is bad",
            check,
            "wire unknown   = setup_mode_i >",
            "wire unknown   = 1'b0 & setup_mode_i >",
        ),
        ("G1 of 1.0 is good", check, "setup_x_step_i > `SAM", "setup_x_step_i >= `SAM"),
        ("G1 above 1.0 is bad", check, "(setup_x_step_i > `SAM_SCALE_ONE) |", ""),
        ("G1 of 565 is good", check, "setup_x_step_i < `SAM", "setup_x_step_i <= `SAM"),
        ("G1 below 565 is bad", check, "| (setup_x_step_i < `SAM_SCALE_MIN)", ""),
        ("the first start", check, "setup_x_start_i + BEFORE", "setup_x_start_i - BEFORE"),
        ("the start behind the last", check, "offset >= AFTER", "offset > AFTER"),
        (
            "the start concerns binocular modes",
            check,
            "(binocular | setup_lend_i) & start_bad",
            "setup_lend_i & start_bad",
        ),
        ("op 3 is void", polygon, "accept_i & (op_i == `SAM_OP_RESERVED)", "1'b0"),
        ("a good LOAD ends it", polygon, "void_o <= refuse", "void_o <= refuse | void_o"),
        (
            "beats before the first LOAD are void",
            polygon,
            "void_o <= 1'b1;\n        else if (accept_i & is_load)",
            "void_o <= 1'b0;\n        else if (accept_i & is_load)",
        ),
    ];
    notice(Target::Minimal, "default", rules);
    let minimal = "sam_minimal.v";
    notice(
        Target::Minimal,
        "default",
        &[
            (
                "the minimal system lends nothing",
                polygon,
                "bad | (setup_lend_i & (LEND == 0))",
                "bad",
            ),
            (
                "void beats draw no primary",
                minimal,
                "s1_eye, ~s1_void & (s1_area",
                "s1_eye, (s1_area",
            ),
            (
                "nor a secondary",
                minimal,
                "~s1_void & s1_binocular & s1_end",
                "s1_binocular & s1_end",
            ),
            ("error is raised", minimal, "(s1_valid & s2_ready & s1_void)", "1'b0"),
            ("error is sticky", minimal, "(error_q & ~error_clear_i) |", ""),
            ("error_clear clears it", minimal, "(error_q & ~error_clear_i)", "error_q"),
            ("a secondary has a candidate", minimal, "s2_wanted & hit", "s2_wanted | hit"),
            ("and is inside", minimal, "s1_x_inside & s1_y_inside", "s1_x_inside | s1_y_inside"),
            (
                "its area is full",
                minimal,
                "slot_secondary_area_i(FULL_AREA",
                "slot_secondary_area_i(~FULL_AREA",
            ),
            ("write 1", minimal, ".slot_secondary_write_i(1'b1)", ".slot_secondary_write_i(1'b0)"),
            (
                "blended 0",
                minimal,
                ".slot_secondary_blended_i(1'b0)",
                ".slot_secondary_blended_i(1'b1)",
            ),
            ("take is centre", minimal, ".beat_take_i(s1_centre_q)", ".beat_take_i(1'b1)"),
        ],
    );
}

/// Half a minute for each of the systems on an idle machine.
#[test]
#[ignore = "takes minutes: a part of scripts/long"]
fn systems() {
    let (hybrid, back, queue) = ("sam_hybrid.v", "sam_hybrid_back.v", "sam_slot_queue.v");
    let check = "sam_setup_check.v";
    notice(
        Target::Hybrid,
        "default",
        &[
            ("lend in a binocular mode is bad", check, "| (binocular & setup_lend_i)", ""),
            (
                "a start concerns lent edges",
                check,
                "(binocular | setup_lend_i) & start_bad",
                "binocular & start_bad",
            ),
            ("three a of 0 are bad", hybrid, "s1_load ? flat : flat_q", "s1_load ? flat_q : flat"),
            ("first: x move or y move", hybrid, "s1_move | (s1_row_move", "s1_move & (s1_row_move"),
            (
                "drawn where depth < stored",
                queue,
                "first_kept[1 +: D] < response_depth_i",
                "first_kept[1 +: D] <= response_depth_i",
            ),
            (
                "dropped where not",
                queue,
                "(colour_valid_i & colour_visible_i)",
                "(colour_valid_i | colour_visible_i)",
            ),
            (
                "the primary is older",
                queue,
                "primary_first ? {first_rgba",
                "~primary_first ? {first_rgba",
            ),
            (
                "planes above 255",
                "sam_clamp.v",
                "+: BITS] | {BITS{above}}",
                "+: BITS] & {BITS{above}}",
            ),
            ("planes below 0", "sam_clamp.v", "& {BITS{~negative}}", "| {BITS{~negative}}"),
            (
                "average where n > 0",
                back,
                "s2_average_i & (count_i !=",
                "s2_average_i & (count_i ==",
            ),
            ("average only with its flag", back, "s2_average_i & (count_i !=", "(count_i !="),
            ("lend cuts the mask", back, "s2_mask_i & (mask | {MB{~s2_lend_i}})", "s2_mask_i"),
            ("lend cuts the centre", back, "s2_centre_i & (centre | ~s2_lend_i)", "s2_centre_i"),
            ("a primary has a mask", back, "s2_draw_i & (primary_mask != {MB{1'b0}})", "s2_draw_i"),
            (
                "a secondary has an area",
                back,
                "s2_secondary_i & (area != {AB{1'b0}})",
                "s2_secondary_i",
            ),
        ],
    );
    notice(
        Target::Hybrid,
        "full",
        &[
            ("colour of the planes", back, "integrated ? plane_rgb_i", "~integrated ? plane_rgb_i"),
            (
                "alpha without planes",
                back,
                "filtered, filtered & ~integrated",
                "filtered & ~integrated, filtered & ~integrated",
            ),
        ],
    );
    notice(
        Target::Hybrid,
        "default depth_test=external",
        &[(
            "external: none is dropped",
            queue,
            "(DEPTH_EXTERNAL != 0) |",
            "(DEPTH_EXTERNAL == 0) |",
        )],
    );
    notice(
        Target::Mono,
        "default",
        &[
            ("a mask", "sam_mono.v", "beat_mask != {MB{1'b0}}", "beat_mask == {MB{1'b0}}"),
            ("for one eye", "sam_mono.v", ".slot_eye_i(~eye_i)", ".slot_eye_i(eye_i)"),
            ("its stream", "sam_mono.v", "= ~out_eye", "= out_eye"),
            (
                "write is centre",
                "sam_mono.v",
                "{beat_centre, beat_x, beat_y,",
                "{~beat_centre, beat_x, beat_y,",
            ),
        ],
    );
}

#[test]
fn traversal() {
    let (traversal, edge) = ("sam_traversal.v", "sam_span_edge.v");
    notice(
        Target::Traversal,
        "default",
        &[
            (
                "a row ends at right",
                traversal,
                "$signed(x_q) >= $signed(right_q)",
                "$signed(x_q) > $signed(right_q)",
            ),
            (
                "save up to left",
                traversal,
                "$signed(x_q) <= $signed(left_q)",
                "$signed(x_q) < $signed(left_q)",
            ),
            (
                "a pixel more",
                traversal,
                "$signed(least) < $signed(left_q)",
                "$signed(least) > $signed(left_q)",
            ),
            ("unless creep", traversal, "~creep_q & (", "creep_q & ("),
            (
                "from the saved row start",
                traversal,
                "visit_save_o ? x_q : saved_q",
                "visit_save_o ? saved_q : x_q",
            ),
            (
                "last at the end of the part",
                traversal,
                "last_q & end_of_part",
                "last_q & end_of_row",
            ),
            (
                "rising edges hold the start",
                edge,
                "a_q[S-1] & inner_q[E-1]",
                "a_q[S-1] | inner_q[E-1]",
            ),
            ("E' is F + bound", edge, "inner_q + {{(E - B)", "inner_q - {{(E - B)"),
            ("down without a pixel", edge, "down_i & ~move_i", "down_i & move_i"),
        ],
    );
    let primary = "sam_primary.v";
    notice(
        Target::Primary,
        "full",
        &[
            ("nothing beyond the width", primary, "visit_x < {{", "visit_x > {{"),
            ("no mask out of view", primary, "mask & {MB{in_view}}", "mask | {MB{in_view}}"),
            (
                "depth starts",
                "sam_primary_planes.v",
                ".beat_start_i(z_start_i)",
                ".beat_start_i(z_row_i)",
            ),
            (
                "red of a row",
                "sam_primary_planes.v",
                ".beat_row_i(red_row_i)",
                ".beat_row_i(green_row_i)",
            ),
            (
                "blue of a step",
                "sam_primary_planes.v",
                ".beat_a_i(blue_a_i)",
                ".beat_a_i(green_a_i)",
            ),
            ("alpha", "sam_primary_planes.v", ".value_i(alpha)", ".value_i(blue)"),
        ],
    );
}
