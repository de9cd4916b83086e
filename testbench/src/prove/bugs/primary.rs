//! Bugs in the primary pipeline.

use super::bug::{bug, bug_in, Bug};

/// All of them.
pub(super) const BUGS: &[Bug] = &[
    bug(
        "span_edge",
        "stays",
        "end else if (advance_i) begin",
        "end else if (advance_i | save_i) begin",
    ),
    bug("span_edge", "steps", "(move_i ? {E{1'b0}} : ~a) : a;", "(move_i ? {E{1'b0}} : ~a) : ~a;"),
    bug("span_edge", "rows", "save_i ? inner_q : saved_q", "save_i ? saved_q : inner_q"),
    bug("span_edge", "loads", "bound_q <= bound_i", "bound_q <= bound_i & ~low_i"),
    bug("span_edge", "starts", "rises_q & inner_q[E-1]", "rises_q | inner_q[E-1]"),
    bug("span_edge", "next", "rises_q & ahead[E-1]", "rises_q & start[E-1]"),
    bug("span_edge", "beyond", "a_q[S-1] & inner_q[E-1]", "a_q[S-1] | inner_q[E-1]"),
    bug(
        "traversal",
        "stable",
        "visit_move_o   = move_q",
        "visit_move_o   = move_q ^ visit_ready_i",
    ),
    bug(
        "traversal",
        "nothing_lost",
        "walk_ready_o   = ~active_q | (visit_ready_i & end_of_part)",
        "walk_ready_o   = ~active_q | end_of_part",
    ),
    bug(
        "traversal",
        "load",
        "op_q   <= end_of_row ? `SAM_OP_ROW",
        "op_q   <= end_of_row ? `SAM_OP_LOAD",
    ),
    bug("traversal", "rows", "rows_q <= rows_q - {", "rows_q <= rows_q + {"),
    bug("traversal", "ends", "(rows_q == {C{1'b0}})", "(rows_q == {C{1'b1}})"),
    bug("traversal", "last", "last_q & end_of_part", "last_q & end_of_row"),
    bug("traversal", "start", "x_q      <= walk_x_i", "x_q      <= walk_left_i"),
    bug("traversal", "step", "$signed(x_q) >= $signed(right_q)", "$signed(x_q) > $signed(right_q)"),
    bug("traversal", "row", "(visit_save_o ? x_q : saved_q)", "(visit_save_o ? saved_q : x_q)"),
    bug("primary_planes", "depth", ".beat_row_i(z_row_i)", ".beat_row_i(z_a_i)"),
    bug("primary_planes", "channels", ".value_i(blue), ", ".value_i(red), "),
    bug("primary_planes", "together", ".beat_ready_o(ready[2]),", ".beat_ready_o(),"),
    bug("hybrid_planes", "depth", ".beat_row_i(z_row_i)", ".beat_row_i(z_a_i)"),
    bug_in("full", "hybrid_planes", "channels", ".value_i(green),", ".value_i(red),"),
    bug(
        "primary",
        "stable",
        ".value_ready_i(beat_ready_i), .depth_o",
        ".value_ready_i(1'b1), .depth_o",
    ),
    bug(
        "primary",
        "planes",
        "assign visit_ready    = stage_ready & (~is_load | planes_valid_i)",
        "assign visit_ready    = stage_ready",
    ),
    bug(
        "primary",
        "loads",
        "assign planes_ready_o = stage_ready & visited & is_load",
        "assign planes_ready_o = visited & is_load",
    ),
    bug(
        "primary",
        "first",
        "{visit_op, visit_save, visit_last,",
        "{visit_op, visit_save, visit_save,",
    ),
    bug(
        "primary",
        "saves",
        "{visit_op, visit_save, visit_last,",
        "{visit_op, visit_last, visit_last,",
    ),
    bug("primary", "mask", "mask & {MB{in_view}}", "mask | {MB{in_view}}"),
];
