//! Planted bugs: one operator of the Verilog is changed, and the regression must notice and name the
//! unit. Each bug is looked for by the unit's own test, where it has one, and inside a system.

use wheatstone_golden::formats::Formats;
use wheatstone_golden::scene;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::regression::{Entry, NamedScene, Plan};
use wheatstone_tests::*;

/// Random beats of a run: the bugs of this file show in a fraction of the default regression.
const BEATS: u64 = 6_000;

/// Who must notice a bug.
struct Search {
    /// The unit by itself, which names itself.
    alone: Option<Target>,
    /// A system with the unit in it.
    system: Target,
    /// Names that the system's failures may have.
    names: &'static [&'static str],
}

/// A search for bugs of a unit, by itself and in a system, both of which name it.
fn within(system: Target, unit: Target) -> Search {
    let names: &[&str] = match unit {
        Target::XInterpolator => &["x_interpolator"],
        Target::YInterpolator => &["y_interpolator"],
        // Its instances are named.
        Target::EdgeInterpolator => &["edge0", "edge1", "edge2", "depth", "red", "green", "blue"],
        Target::Sampler => &["sampler"],
        Target::Filter => &["filter"],
        Target::Coverage => &["coverage"],
        Target::Blend => &["blend"],
        Target::Display => &["display"],
        Target::Traversal | Target::Primary | Target::Mono | Target::Stereo => &["primary"],
        // Nothing watches the streams into these.
        Target::Redirect | Target::Minimal | Target::Hybrid if system == Target::Minimal => {
            &["minimal"]
        }
        Target::Redirect | Target::Minimal | Target::Hybrid => &["hybrid"],
    };
    Search { alone: (!unit.is_system()).then_some(unit), system, names }
}

/// The fault in the reports of a target: it must have failed, and every failure must name the unit.
fn fault(entries: &[Entry], target: Target, names: &[&str]) -> Option<String> {
    let entries = entries.iter().filter(|entry| entry.target == target);
    let mut failures = entries.filter_map(|entry| entry.failure.as_ref()).peekable();
    if failures.peek().is_none() {
        return Some(format!("{} did not notice", target.name()));
    }
    let mut wrong = failures.filter(|failure| !names.contains(&failure.unit.as_str()));
    wrong.next().map(|failure| format!("expected {}\n{failure}", names.join(" or ")))
}

impl Search {
    /// Plants bugs in copies of a file, one at a time: replaces a text that occurs once. The
    /// configuration is a name, then parameters.
    fn catches(&self, configuration: &str, file: &str, bugs: &[(&str, &str)]) {
        let mut words = configuration.split(' ');
        let name = words.next().unwrap_or_default();
        let settings = settings(name, &words.collect::<Vec<_>>());
        let targets: Vec<Target> = self.alone.into_iter().chain([self.system]).collect();
        let mut plan = plan(&targets, settings, BEATS);
        let mut faults = Vec::new();
        for (find, replace) in bugs {
            let copy = copy_of_rtl();
            plant(copy.path(), file, find, replace);
            plan.rtl = copy.path().to_owned();
            let entries = run(&plan, &quick_builder());
            let by_itself = self.alone.and_then(|unit| fault(&entries, unit, &[unit.name()]));
            for fault in by_itself.into_iter().chain(fault(&entries, self.system, self.names)) {
                faults.push(format!("{file}: {find} → {replace} ({configuration}): {fault}"));
            }
        }
        assert!(faults.is_empty(), "\n{}", faults.join("\n"));
    }
}

#[test]
fn x_interpolator() {
    let file = "sam_x_interpolator.v";
    let hybrid = within(Target::Hybrid, Target::XInterpolator);
    hybrid.catches(
        "default",
        file,
        &[
            ("from + by", "from - by"),
            ("sum[F] ^ from[F] ^ by[F]", "sum[F] ^ from[F] | by[F]"),
            ("~acc_q[F-1] | (", "~acc_q[F-1] & ("),
        ],
    );
    let minimal = within(Target::Minimal, Target::XInterpolator);
    minimal.catches(
        "default",
        file,
        &[("~is_row & step_q[F]", "is_row & step_q[F]"), ("moves & ~is_load", "moves | ~is_load")],
    );
    minimal.catches(
        "paper",
        file,
        &[
            ("acc_q[X-1:F] < {", "acc_q[X-1:F] <= {"),
            ("back ? saved_q : acc_q", "back ? acc_q : saved_q"),
        ],
    );
}

#[test]
fn y_interpolator() {
    let file = "sam_y_interpolator.v";
    let hybrid = within(Target::Hybrid, Target::YInterpolator);
    hybrid.catches("default", file, &[("y_q + step_wide", "y_q - step_wide")]);
    hybrid.catches("full", file, &[("is_row ? row_q : slant_wide", "is_row ? slant_wide : row_q")]);
    let minimal = within(Target::Minimal, Target::YInterpolator);
    minimal.catches(
        "default",
        file,
        &[
            ("accept & is_row", "accept & ~is_row"),
            ("pixel_end_o    = last_q | ~is_step;", "pixel_end_o    = last_q | is_step;"),
        ],
    );
    minimal.catches(
        "full",
        file,
        &[
            ("sum[F] ^ from[F] ^ by[F]", "sum[F] ^ from[F] & by[F]"),
            ("y_q + once + twice", "y_q + once - twice"),
            ("step_q[2] ? ~{v", "step_q[2] ? {v"),
            ("v < {", "v <= {"),
        ],
    );
}

#[test]
fn edge_interpolator() {
    let file = "sam_edge_interpolator.v";
    let hybrid = within(Target::Hybrid, Target::EdgeInterpolator);
    hybrid.catches(
        "default",
        file,
        &[
            ("value_d = from + by;", "value_d = from - by;"),
            ("beat_move_i & ~is_load", "beat_move_i | ~is_load"),
            ("moves ? row_a_q : row_q", "moves ? row_q : row_a_q"),
        ],
    );
    hybrid.catches("paper", file, &[("back ? saved_q : value_q", "back ? value_q : saved_q")]);
    hybrid.catches(
        "full",
        file,
        &[
            ("(size ^ {BITS{minus}})", "(size | {BITS{minus}})"),
            ("beat_y_move_i[1] & ~is_load", "beat_y_move_i[1] & is_load"),
            ("value_d = from + by + (", "value_d = from + by - ("),
        ],
    );
}

#[test]
fn sampler() {
    let file = "sam_sampler.v";
    // The hybrid takes every beat as a candidate; only the minimal system has pixels without one.
    let minimal = within(Target::Minimal, Target::Sampler);
    minimal.catches(
        "default",
        file,
        &[("beat_take_i & (", "beat_take_i | ("), ("else if (~hit)", "else if (hit)")],
    );
    minimal.catches("paper", file, &[("hit | beat_take_i", "hit & beat_take_i")]);
    let hybrid = within(Target::Hybrid, Target::Sampler);
    hybrid.catches(
        "default",
        file,
        &[
            ("hit_q & ~beat_first_i", "hit_q & beat_first_i"),
            ("~hit | beat_near_i", "~hit & beat_near_i"),
        ],
    );
    hybrid.catches("paper", file, &[("beat_valid_i & beat_end_i", "beat_valid_i | beat_end_i")]);
}

#[test]
fn filter() {
    let hybrid = within(Target::Hybrid, Target::Filter);
    hybrid.catches(
        "default",
        "sam_filter.v",
        &[
            ("beat_include_i & ~full", "beat_include_i | ~full"),
            ("so_many[0] & (", "so_many[0] | ("),
            ("(so_many == 0) |", "(so_many != 0) |"),
            ("{so_far, 1'b1} + {", "{so_far, 1'b1} - {"),
            ("beat_first_i | (count_q == 0)", "beat_first_i | (count_q != 0)"),
            ("beat_valid_i & beat_end_i", "beat_valid_i | beat_end_i"),
        ],
    );
}

#[test]
fn filter_division() {
    let file = "sam_filter_division.v";
    let hybrid = within(Target::Hybrid, Target::Filter);
    hybrid.catches("default", file, &[("{18'd0, sum_i} * {", "{18'd0, sum_i} + {")]);
    hybrid.catches(
        "paper",
        file,
        &[
            ("+: 4] - p", "+: 4] + p"),
            ("{1'b0, sum_i} + {", "{1'b0, sum_i} - {"),
            ("rounded[7:0] | {", "rounded[7:0] & {"),
        ],
    );
    hybrid.catches(
        "default filter=3",
        file,
        &[
            ("= (scaled >> P", "= (scaled << P"),
            ("+ (scaled >> Q", "- (scaled >> Q"),
            ("+ {13'd0, 1'b1", "- {13'd0, 1'b1"),
            ("total[SHIFT +: 8] | {", "total[SHIFT +: 8] & {"),
        ],
    );
}

#[test]
fn coverage() {
    let edge = "sam_coverage_edge.v";
    let hybrid = within(Target::Hybrid, Target::Coverage);
    hybrid.catches(
        "default",
        "sam_coverage.v",
        &[
            ("edges_value0_i[E-1] | edges_value1", "edges_value0_i[E-1] & edges_value1"),
            ("wire centre = ~(", "wire centre = ("),
        ],
    );
    hybrid.catches("full", "sam_coverage.v", &[("mask0 & mask1 & mask2", "mask0 & mask1 | mask2")]);
    hybrid.catches(
        "full",
        edge,
        &[("plus = a + b", "plus = a - b"), ("sample_7  = here + {", "sample_7  = here - {")],
    );
    hybrid.catches(
        "paper",
        edge,
        &[
            ("huge ? {2{~sign}}", "huge ? {2{sign}}"),
            ("below = here + b", "below = here - b"),
            ("sample_12 = below - less", "sample_12 = below + less"),
        ],
    );
    // The area of the primary pixel is counted by the same module.
    let hybrid = Search { names: &["coverage", "hybrid"], ..hybrid };
    hybrid.catches("paper", "sam_popcount.v", &[("ones = ones + {", "ones = ones - {")]);
}

#[test]
fn blend() {
    let file = "sam_blend.v";
    let hybrid = within(Target::Hybrid, Target::Blend);
    hybrid.catches(
        "default",
        file,
        &[
            ("{1'b0, pixel_alpha_i} + {", "{1'b0, pixel_alpha_i} - {"),
            ("pixel_area_i[0] ? alpha : 9'd0", "pixel_area_i[0] ? 9'd0 : alpha"),
            ("pixel_rgb_i[8*i +: 8]} - {", "pixel_rgb_i[8*i +: 8]} + {"),
            ("1'b1} + change_q", "1'b1} - change_q"),
            ("factor_valid_q & colour_free) change_q", "factor_valid_q | colour_free) change_q"),
        ],
    );
    hybrid.catches(
        "paper",
        file,
        &[
            ("pixel_area_i} + 14'd8", "pixel_area_i} - 14'd8"),
            ("{5'd0, alpha} * {", "{5'd0, alpha} + {"),
        ],
    );
}

#[test]
fn display() {
    let file = "sam_display.v";
    let hybrid = within(Target::Hybrid, Target::Display);
    hybrid.catches(
        "default",
        file,
        &[
            ("width_i + ~point_x_i", "width_i - ~point_x_i"),
            ("point_mirror_i ? from_right", "~point_mirror_i ? from_right"),
        ],
    );
    let minimal = within(Target::Minimal, Target::Display);
    minimal.catches(
        "default",
        file,
        &[
            ("point_swap_i ? point_y_i", "~point_swap_i ? point_y_i"),
            ("point_swap_i ? column : point_y_i", "point_swap_i ? column & point_y_i : point_y_i"),
        ],
    );
    minimal.catches("paper", file, &[("~valid_q | pixel_ready_i", "~valid_q & pixel_ready_i")]);
}

#[test]
fn redirect() {
    let file = "sam_redirect.v";
    let hybrid = within(Target::Hybrid, Target::Redirect);
    hybrid.catches(
        "default",
        file,
        &[
            ("slot_primary_i & ~primary_gone_q", "slot_primary_i | ~primary_gone_q"),
            ("left_ready_i & ~primary_here", "left_ready_i | ~primary_here"),
        ],
    );
    let minimal = within(Target::Minimal, Target::Redirect);
    minimal.catches(
        "default",
        file,
        &[
            ("single_i ? primary_here : ~slot_eye_i", "single_i ? primary_here : slot_eye_i"),
            ("~secondary_here | secondary_taken", "~secondary_here & secondary_taken"),
            ("primary_done & ~secondary_done", "primary_done | ~secondary_done"),
        ],
    );
    minimal.catches("paper", file, &[("eye_i ^ ~right_primary", "eye_i & ~right_primary")]);
}

#[test]
fn slot_queue() {
    let file = "sam_slot_queue.v";
    let names = &["hybrid", "slot_queue"];
    let hybrid = Search { alone: None, system: Target::Hybrid, names };
    hybrid.catches(
        "default",
        file,
        &[
            ("first_kept[1 +: D] < response_depth_i", "first_kept[1 +: D] <= response_depth_i"),
            ("(colour_valid_i & colour_visible_i)", "(colour_valid_i | colour_visible_i)"),
            ("eyes_q[front_eye]", "eyes_q[~front_eye]"),
            ("out_ready_i(first_taken)", "out_ready_i(1'b1)"),
            ("full_q | (push &", "full_q & (push &"),
            ("~secondary_here | (request", "~secondary_here & (request"),
            ("held & (single_i |", "held & (single_i &"),
            ("primary_first ? {first_rgba", "~primary_first ? {first_rgba"),
        ],
    );
    hybrid.catches(
        "paper",
        file,
        &[
            ("way_eye[I-1:0] ~^", "way_eye[I-1:0] ^"),
            ("~full | (SHORT & pop)", "~full | (SHORT | pop)"),
            ("(queued & room) | (", "(queued | room) & ("),
        ],
    );
    hybrid.catches(
        "default depth_test=external",
        file,
        &[("(DEPTH_EXTERNAL != 0) |", "(DEPTH_EXTERNAL == 0) |")],
    );
}

/// A read that does not wait is answered too early, where stalls keep two pixels of one place under
/// way: the memory's answer is compared with the golden model's.
#[test]
fn slot_queue_in_one_scene() {
    let copy = copy_of_rtl();
    let (find, replace) = ("& room & ~waits", "& room");
    plant(copy.path(), "sam_slot_queue.v", find, replace);
    let settings = settings("default", &[]);
    let formats = Formats::new(&settings.config);
    let scene = scene::open("teapot", Some([160, 120]), None).expect("a built-in scene");
    let geometry = scene.geometry(&formats, &scene::Options::default()).expect("it is sound");
    let job = Job::of(&geometry, settings.config, settings.options, settings.lookup);
    let mut plan: Plan = plan(&[Target::Hybrid], settings, BEATS);
    (plan.seed, plan.scenes_only, plan.rtl) = (3, true, copy.path().to_owned());
    plan.scenes = vec![NamedScene { name: "teapot".into(), job }];
    let entries = run(&plan, &quick_builder());
    let [Entry { failure: Some(failure), .. }] = &entries[..] else {
        panic!("nothing was noticed")
    };
    assert_eq!(failure.unit, "slot_queue", "{failure}");
    assert_eq!(
        (failure.stream.as_deref(), failure.field.as_deref()),
        (Some("response"), Some("rgb"))
    );
    // Values as in all other streams.
    let [expected, actual] =
        [&failure.expected, &failure.actual].map(|v| v.clone().unwrap_or_default());
    assert!(expected.starts_with('#') && actual.len() == 7, "{failure}");
    assert!(failure
        .what
        .contains(&format!("rgb expected {expected}, got {actual}; depth expected ")));
}

#[test]
fn setup_check() {
    let file = "sam_setup_check.v";
    within(Target::Hybrid, Target::Hybrid).catches(
        "default",
        file,
        &[
            ("setup_mode_i > `SAM", "setup_mode_i < `SAM"),
            ("binocular & setup_lend_i", "binocular | setup_lend_i"),
        ],
    );
    let minimal = within(Target::Minimal, Target::Minimal);
    minimal.catches(
        "default",
        file,
        &[
            ("setup_x_step_i > `SAM", "setup_x_step_i >= `SAM"),
            ("setup_x_step_i < `SAM", "setup_x_step_i <= `SAM"),
        ],
    );
    minimal.catches(
        "paper",
        file,
        &[
            ("setup_x_start_i + BEFORE", "setup_x_start_i - BEFORE"),
            ("offset >= AFTER", "offset > AFTER"),
        ],
    );
}

#[test]
fn parts_of_the_systems() {
    let minimal = within(Target::Minimal, Target::Minimal);
    minimal.catches(
        "default",
        "sam_polygon.v",
        &[
            ("op_i == `SAM_OP_RESERVED", "op_i != `SAM_OP_RESERVED"),
            ("void_o <= refuse", "void_o <= ~refuse"),
            ("setup_lend_i & (LEND == 0)", "setup_lend_i & (LEND != 0)"),
            ("bad | (setup_lend_i", "bad & (setup_lend_i"),
            ("accept_i & is_load)                       void", "accept_i | is_load) void"),
        ],
    );
    minimal.catches("default", "sam_stage.v", &[("else if (in_ready_o)", "else if (~in_ready_o)")]);
    within(Target::Hybrid, Target::Hybrid).catches(
        "default",
        "sam_buffer.v",
        &[
            ("read_q ? data1_q : data0_q", "read_q ? data0_q : data1_q"),
            ("& ~(read & read_q)) |", "& (read & read_q)) |"),
            ("write_q ^ write", "write_q | write"),
            ("(write & write_q)", "(write | write_q)"),
        ],
    );
    minimal.catches("paper", "sam_popcount.v", &[("ones = ones + {", "ones = ones - {")]);
    minimal.catches(
        "default",
        "sam_minimal.v",
        &[
            ("s2_wanted & hit", "s2_wanted | hit"),
            ("s1_x_inside & s1_y_inside", "~s1_x_inside & s1_y_inside"),
            ("s1_area_q != {A{1'b0}}", "s1_area_q == {A{1'b0}}"),
        ],
    );
    let hybrid = within(Target::Hybrid, Target::Hybrid);
    hybrid.catches(
        "default",
        "sam_clamp.v",
        &[
            ("+: BITS] | {BITS{above}}", "+: BITS] & {BITS{above}}"),
            ("& {BITS{~negative}}", "| {BITS{~negative}}"),
        ],
    );
    hybrid.catches(
        "full",
        "sam_hybrid_back.v",
        &[
            ("centre | ~s2_lend_i", "centre & ~s2_lend_i"),
            ("integrated ? plane_rgb_i", "~integrated ? plane_rgb_i"),
        ],
    );
    hybrid.catches(
        "default",
        "sam_hybrid.v",
        &[("s1_load ? flat : flat_q", "s1_load ? flat_q : flat")],
    );
}

#[test]
fn primary_pipeline() {
    let traversal = within(Target::Stereo, Target::Traversal);
    traversal.catches(
        "default",
        "sam_traversal.v",
        &[
            ("$signed(x_q) >= $signed(right_q)", "$signed(x_q) > $signed(right_q)"),
            ("$signed(x_q) <= $signed(left_q)", "$signed(x_q) < $signed(left_q)"),
            ("$signed(least) < $signed(left_q)", "$signed(least) > $signed(left_q)"),
            ("~creep_q & (", "creep_q & ("),
            ("visit_save_o ? x_q : saved_q", "visit_save_o ? saved_q : x_q"),
            ("last_q & end_of_part", "last_q & end_of_row"),
        ],
    );
    traversal.catches(
        "default",
        "sam_span_edge.v",
        &[
            ("save_i ? inner_q : saved_q", "save_i ? saved_q : inner_q"),
            ("move_i ? {E{1'b0}} : ~a", "move_i ? ~a : {E{1'b0}}"),
            ("down_i & ~move_i", "down_i & move_i"),
            ("rises_q & ahead[E-1]", "~rises_q & ahead[E-1]"),
            ("a_q[S-1] & inner_q[E-1]", "a_q[S-1] | inner_q[E-1]"),
            ("inner_q + {{(E - B)", "inner_q - {{(E - B)"),
        ],
    );
    let primary = within(Target::Stereo, Target::Primary);
    primary.catches(
        "default",
        "sam_primary.v",
        &[
            ("visit_x < {{", "visit_x > {{"),
            ("mask & {MB{in_view}}", "mask | {MB{in_view}}"),
            ("visited & (~is_load | planes_valid_i)", "visited & (~is_load & planes_valid_i)"),
            ("stage_ready & (~is_load", "stage_ready | (~is_load"),
            ("visit_save, visit_last, centre,", "visit_save, visit_last, ~centre,"),
        ],
    );
    primary.catches(
        "full",
        "sam_primary_planes.v",
        &[
            (".beat_start_i(z_start_i)", ".beat_start_i(z_row_i)"),
            (".beat_row_i(red_row_i)", ".beat_row_i(green_row_i)"),
            (".beat_a_i(blue_a_i)", ".beat_a_i(green_a_i)"),
            (".value_i(alpha)", ".value_i(blue)"),
            (".value_i(red), ", ".value_i(alpha), "),
        ],
    );
    let joined = Search {
        alone: None,
        system: Target::Stereo,
        names: &["primary", "x_interpolator", "edge0", "edge1", "edge2", "depth", "display"],
    };
    joined.catches(
        "default",
        "sam_stereo.v",
        &[(".beat_save_i(beat_save)", ".beat_save_i(~beat_save)")],
    );
}

#[test]
fn monocular_pipeline() {
    let mono = Search { alone: None, system: Target::Mono, names: &["mono", "slot_queue"] };
    mono.catches(
        "default",
        "sam_mono.v",
        &[
            ("beat_mask != {MB{1'b0}}", "beat_mask == {MB{1'b0}}"),
            (".slot_eye_i(~eye_i)", ".slot_eye_i(eye_i)"),
            (".colour_visible_i(colour_visible)", ".colour_visible_i(~colour_visible)"),
            ("= ~out_eye", "= out_eye"),
            ("{beat_centre, beat_x, beat_y,", "{~beat_centre, beat_x, beat_y,"),
        ],
    );
}
