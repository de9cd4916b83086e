// Traversal of the primary pipeline: visits the pixels of a polygon part, scan line by scan line from
// the left. The ends of a row are found by the signs of the edge functions and two columns.
//
// Latency: one clock from `walk` to its first pixel, then a pixel a clock.
// Reset: rst_i clears active_q; a part renews all else.
// Paper: section 3; docs/theory.md (extended span), docs/primary.md.
`include "sam_formats.vh"
`default_nettype none

module sam_traversal #(
    // Fraction bits of a snapped vertex, sets the width of every coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire                                           clk_i, rst_i,

    input  wire                                           walk_valid_i,
    output wire                                           walk_ready_o,
    input  wire                                           walk_last_i, walk_creep_i, walk_swap_i, walk_mirror_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] walk_rows_i, walk_y_i,
    input  wire [`SAM_DISPLAY_STEP_BITS-1:0]              walk_y_step_i,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    walk_x_i, walk_x_row_i, walk_left_i, walk_right_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e0_start_i, walk_e0_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e0_a_i, walk_e0_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e0_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e0_bound_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e1_start_i, walk_e1_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e1_a_i, walk_e1_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e1_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e1_bound_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       walk_e2_start_i, walk_e2_row_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      walk_e2_a_i, walk_e2_b_i,
    input  wire [`SAM_LOW_BITS-1:0]                       walk_e2_low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0]      walk_e2_bound_i,

    output wire                                           visit_valid_o,
    input  wire                                           visit_ready_i,
    output wire [`SAM_OP_BITS-1:0]                        visit_op_o,
    output wire                                           visit_save_o, visit_last_o, visit_move_o, visit_swap_o, visit_mirror_o,
    output wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    visit_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] visit_y_o,
    output wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       visit_value0_o,
    output wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      visit_a0_o, visit_b0_o,
    output wire [`SAM_LOW_BITS-1:0]                       visit_low0_o,
    output wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       visit_value1_o,
    output wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      visit_a1_o, visit_b1_o,
    output wire [`SAM_LOW_BITS-1:0]                       visit_low1_o,
    output wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]       visit_value2_o,
    output wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0]      visit_a2_o, visit_b2_o,
    output wire [`SAM_LOW_BITS-1:0]                       visit_low2_o
);
    localparam P = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam D = `SAM_DISPLAY_STEP_BITS;

    // The parameter is checked by the edges.

    reg                    active_q, last_q, creep_q, swap_q, mirror_q, move_q;
    reg [`SAM_OP_BITS-1:0] op_q;
    reg [C-1:0]            rows_q;
    reg [C-1:0]            y_q;
    reg [D-1:0]            y_step_q;
    reg [P-1:0]            x_q;
    reg [P-1:0]            saved_q;
    reg [P-1:0]            x_row_q;
    reg [P-1:0]            left_q;
    reg [P-1:0]            right_q;

    wire [2:0] starts, next_starts, beyond;

    wire end_of_row  = (beyond != 3'd0) | ($signed(x_q) >= $signed(right_q));
    wire end_of_part = end_of_row & (rows_q == {C{1'b0}});
    wire taken       = active_q & visit_ready_i;
    wire load        = walk_valid_i & walk_ready_o;
    wire advance     = taken & ~end_of_part;

    // The next row starts at the least movement or, where that is left of the span, a pixel further.
    // If the secondary follows, it starts there all the same, and creeps.
    wire [P-1:0] least   = (visit_save_o ? x_q : saved_q) + x_row_q;
    wire         further = ~creep_q & ((next_starts != 3'd0) | ($signed(least) < $signed(left_q)));
    wire         right   = ~end_of_row | further;
    wire [P-1:0] from    = end_of_row ? least : x_q;

    assign walk_ready_o   = ~active_q | (visit_ready_i & end_of_part);
    assign visit_valid_o  = active_q;
    assign visit_op_o     = op_q;
    // A part starts where it starts, whatever its edges say.
    assign visit_save_o   = (op_q == `SAM_OP_LOAD) | (starts != 3'd0) | ($signed(x_q) <= $signed(left_q));
    assign visit_last_o   = last_q & end_of_part;
    assign visit_move_o   = move_q;
    assign visit_swap_o   = swap_q;
    assign visit_mirror_o = mirror_q;
    assign visit_x_o      = x_q;
    assign visit_y_o      = y_q;

    always @(posedge clk_i) begin
        if (rst_i)             active_q <= 1'b0;
        else if (walk_ready_o) active_q <= walk_valid_i;

        if (load) begin
            op_q     <= `SAM_OP_LOAD;
            move_q   <= 1'b0;
            last_q   <= walk_last_i;
            creep_q  <= walk_creep_i;
            swap_q   <= walk_swap_i;
            mirror_q <= walk_mirror_i;
            rows_q   <= walk_rows_i;
            y_q      <= walk_y_i;
            y_step_q <= walk_y_step_i;
            x_q      <= walk_x_i;
            x_row_q  <= walk_x_row_i;
            left_q   <= walk_left_i;
            right_q  <= walk_right_i;
        end else if (advance) begin
            op_q   <= end_of_row ? `SAM_OP_ROW : `SAM_OP_STEP;
            move_q <= right;
            x_q    <= from + {{(P - 1){1'b0}}, right};
            if (end_of_row) begin
                rows_q <= rows_q - {{(C - 1){1'b0}}, 1'b1};
                y_q    <= y_q + {{(C - D){y_step_q[D-1]}}, y_step_q};
            end
        end
        if (advance & visit_save_o) saved_q <= x_q;
    end

    sam_span_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge0 (
        .clk_i(clk_i), .load_i(load), .start_i(walk_e0_start_i), .a_i(walk_e0_a_i), .b_i(walk_e0_b_i),
        .row_i(walk_e0_row_i), .low_i(walk_e0_low_i), .bound_i(walk_e0_bound_i),
        .advance_i(advance), .down_i(end_of_row), .move_i(further), .save_i(visit_save_o),
        .starts_o(starts[0]), .next_starts_o(next_starts[0]), .beyond_o(beyond[0]),
        .value_o(visit_value0_o), .a_o(visit_a0_o), .b_o(visit_b0_o), .low_o(visit_low0_o)
    );

    sam_span_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge1 (
        .clk_i(clk_i), .load_i(load), .start_i(walk_e1_start_i), .a_i(walk_e1_a_i), .b_i(walk_e1_b_i),
        .row_i(walk_e1_row_i), .low_i(walk_e1_low_i), .bound_i(walk_e1_bound_i),
        .advance_i(advance), .down_i(end_of_row), .move_i(further), .save_i(visit_save_o),
        .starts_o(starts[1]), .next_starts_o(next_starts[1]), .beyond_o(beyond[1]),
        .value_o(visit_value1_o), .a_o(visit_a1_o), .b_o(visit_b1_o), .low_o(visit_low1_o)
    );

    sam_span_edge #(.SUBPIXEL_BITS(SUBPIXEL_BITS)) u_edge2 (
        .clk_i(clk_i), .load_i(load), .start_i(walk_e2_start_i), .a_i(walk_e2_a_i), .b_i(walk_e2_b_i),
        .row_i(walk_e2_row_i), .low_i(walk_e2_low_i), .bound_i(walk_e2_bound_i),
        .advance_i(advance), .down_i(end_of_row), .move_i(further), .save_i(visit_save_o),
        .starts_o(starts[2]), .next_starts_o(next_starts[2]), .beyond_o(beyond[2]),
        .value_o(visit_value2_o), .a_o(visit_a2_o), .b_o(visit_b2_o), .low_o(visit_low2_o)
    );

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The part inside, told from the ports: what is left of it, and where its row start is.
    wire f_take = walk_valid_i & walk_ready_o;
    wire f_give = visit_valid_o & visit_ready_i;
    reg               f_inside, f_last, f_fresh;
    reg [C-1:0]       f_rows, f_y, f_before_y;
    reg signed [P-1:0] f_x, f_row_start, f_right, f_x_row;
    reg signed [D-1:0] f_y_step;
    wire signed [C-1:0] f_down = f_y_step;
    wire signed [P-1:0] f_moved = f_x + visit_move_o;
    wire signed [P-1:0] f_row_at = f_row_start + f_x_row + visit_move_o;
    // The last pixel of a part is the one with which the next part is taken or the stage is empty.
    wire f_ends = f_give & walk_ready_o;

    always @(posedge clk_i) begin
        f_inside <= ~rst_i & (f_take | (f_inside & ~f_ends));
        if (f_give) begin
            {f_x, f_y} <= {visit_x_o, visit_y_o};
            if (visit_save_o) f_row_start <= visit_x_o;
            if (visit_op_o == `SAM_OP_ROW) f_rows <= f_rows - 1;
        end
        if (f_give) f_fresh <= 1'b0;
        if (f_take) begin
            {f_fresh, f_last, f_rows, f_right, f_x_row, f_y_step}
                <= {1'b1, walk_last_i, walk_rows_i, walk_right_i, walk_x_row_i, walk_y_step_i};
            {f_x, f_y} <= {walk_x_i, walk_y_i};
        end
    end
    wire [C-1:0] f_rows_now = f_rows - (f_inside & ~f_fresh & visit_op_o == `SAM_OP_ROW);

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(visit_valid_o, visit_ready_i, {visit_op_o, visit_save_o, visit_last_o,
            visit_move_o, visit_swap_o, visit_mirror_o, visit_x_o, visit_y_o, visit_value0_o, visit_value1_o,
            visit_value2_o, visit_a0_o, visit_a1_o, visit_a2_o, visit_b0_o, visit_b1_o, visit_b2_o,
            visit_low0_o, visit_low1_o, visit_low2_o}));
        // Pixels are offered exactly while a part is inside, a part is taken when the one before ends.
        p_nothing_lost: assert (visit_valid_o == f_inside & (~f_take | ~f_inside | f_ends));
        // A part begins with its LOAD, and has no other.
        p_load: assert (~f_inside | (visit_op_o == `SAM_OP_LOAD) == f_fresh);
        // A part has as many rows as its record says: it ends in the last one, and with no other.
        p_rows: assert (~f_ends | rst_i | f_rows_now == 0);
        // A further row begins only while the record has rows left: with the end of every row at its right end at
        // the latest, whatever the record says, every part ends.
        p_ends: assert (~f_inside | f_fresh | visit_op_o != `SAM_OP_ROW | f_rows != 0);
        // Only the last pixel of a part is last, where the record says so.
        p_last: assert (~f_give | visit_last_o == (f_last & f_ends));
        // The first pixel is where the record says.
        p_start: assert (~f_inside | ~f_fresh | (visit_x_o == f_x & visit_y_o == f_y & visit_save_o));
        // A step goes one to the right in the same line, from a pixel left of the record's right end.
        p_step: assert (~f_inside | visit_op_o != `SAM_OP_STEP | (visit_move_o & visit_x_o == f_moved & visit_y_o == f_y
                        & f_x < f_right));
        // A row begins at the row start and increment, or a pixel further, on the next line.
        p_row: assert (~f_inside | visit_op_o != `SAM_OP_ROW | (visit_x_o == f_row_at & visit_y_o == f_y + f_down));
        // Lemma: registers are what the ports tell.
        lemma: assert (active_q == f_inside & (~f_inside | ({rows_q, last_q, right_q, x_row_q, y_step_q}
                       == {f_rows_now, f_last, f_right, f_x_row, f_y_step})));
        lemma_start: assert (~f_inside | f_fresh | saved_q == f_row_start);
    end
`endif
endmodule

`default_nettype wire
