// Pixel redirection: sends the primary and the secondary pixel of a slot to the streams of their
// eyes, or both to one display, the primary first.
//
// Latency: none, the payload passes through.
// Reset: rst_i clears the two notes of which pixel of the present slot is already gone.
// Paper: section 5.8.
`include "sam_formats.vh"
`default_nettype none

module sam_redirect #(
    // Fraction bits of a snapped vertex, sets the width of a coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8,
    // 16 coverage samples a pixel, sets the width of an area: 0 or 1.
    parameter ANTIALIAS = 0
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire                                           single_i,

    input  wire                                           slot_valid_i,
    output wire                                           slot_ready_o,
    input  wire                                           slot_primary_i,
    input  wire                                           slot_secondary_i,
    input  wire                                           slot_eye_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_primary_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_primary_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      slot_primary_rgba_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           slot_primary_area_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     slot_primary_depth_i,
    input  wire                                           slot_primary_write_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_secondary_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] slot_secondary_y_i,
    input  wire [`SAM_RGBA_BITS-1:0]                      slot_secondary_rgba_i,
    input  wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           slot_secondary_area_i,
    input  wire [`SAM_DEPTH_BITS-1:0]                     slot_secondary_depth_i,
    input  wire                                           slot_secondary_write_i,
    input  wire                                           slot_secondary_blended_i,

    output wire                                           left_valid_o,
    input  wire                                           left_ready_i,
    output wire                                           left_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] left_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] left_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      left_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           left_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     left_depth_o,
    output wire                                           left_write_o,
    output wire                                           left_blended_o,

    output wire                                           right_valid_o,
    input  wire                                           right_ready_i,
    output wire                                           right_eye_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] right_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] right_y_o,
    output wire [`SAM_RGBA_BITS-1:0]                      right_rgba_o,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0]           right_area_o,
    output wire [`SAM_DEPTH_BITS-1:0]                     right_depth_o,
    output wire                                           right_write_o,
    output wire                                           right_blended_o
);
    // A pixel as one word.
    localparam W = 2 * `SAM_COORDINATE_BITS(SUBPIXEL_BITS) + `SAM_RGBA_BITS
                 + `SAM_AREA_BITS(ANTIALIAS) + `SAM_DEPTH_BITS + 2;

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal_subpixel_bits
            sam_redirect_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal_antialias
            sam_redirect_ANTIALIAS_must_be_0_or_1 u_error ();
        end
    endgenerate

    reg primary_gone_q;
    reg secondary_gone_q;

    wire primary_here   = slot_primary_i & ~primary_gone_q;
    wire secondary_here = slot_secondary_i & ~secondary_gone_q;

    // Which pixel each stream shows. Only this and the valids depend on `single`: in a single
    // stream the secondary waits until the primary has gone.
    wire left_primary  = single_i ? primary_here : ~slot_eye_i;
    wire right_primary = slot_eye_i;

    assign left_valid_o  = slot_valid_i & (left_primary ? primary_here : secondary_here);
    assign right_valid_o = slot_valid_i & ~single_i & (right_primary ? primary_here : secondary_here);

    // The pixel is on a stream that takes it.
    wire primary_taken   = (single_i | ~slot_eye_i) ? left_ready_i : right_ready_i;
    wire secondary_taken = single_i ? (left_ready_i & ~primary_here)
                                    : (slot_eye_i ? left_ready_i : right_ready_i);

    wire primary_done   = ~primary_here | primary_taken;
    wire secondary_done = ~secondary_here | secondary_taken;

    assign slot_ready_o = ~slot_valid_i | (primary_done & secondary_done);

    always @(posedge clk_i) begin
        if (rst_i) begin
            primary_gone_q   <= 1'b0;
            secondary_gone_q <= 1'b0;
        end else begin
            // Only one that was there: the other one may join a slot that waits.
            primary_gone_q   <= slot_valid_i & slot_primary_i & primary_done & ~secondary_done;
            secondary_gone_q <= slot_valid_i & slot_secondary_i & secondary_done & ~primary_done;
        end
    end

    wire [W-1:0] primary = {
        1'b0, slot_primary_write_i, slot_primary_depth_i, slot_primary_area_i,
        slot_primary_rgba_i, slot_primary_y_i, slot_primary_x_i
    };
    wire [W-1:0] secondary = {
        slot_secondary_blended_i, slot_secondary_write_i, slot_secondary_depth_i,
        slot_secondary_area_i, slot_secondary_rgba_i, slot_secondary_y_i, slot_secondary_x_i
    };

    assign {left_blended_o, left_write_o, left_depth_o, left_area_o, left_rgba_o, left_y_o, left_x_o}
        = left_primary ? primary : secondary;
    assign {right_blended_o, right_write_o, right_depth_o, right_area_o, right_rgba_o, right_y_o,
            right_x_o} = right_primary ? primary : secondary;
    assign left_eye_o  = slot_eye_i ^ ~left_primary;
    assign right_eye_o = slot_eye_i ^ ~right_primary;

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // What of the slot has gone, told from the ports by the eye of what leaves.
    wire f_left  = left_valid_o & left_ready_i;
    wire f_right = right_valid_o & right_ready_i;
    wire f_primary   = (f_left & left_eye_o == slot_eye_i) | (f_right & right_eye_o == slot_eye_i);
    wire f_secondary = (f_left & left_eye_o != slot_eye_i) | (f_right & right_eye_o != slot_eye_i);
    wire f_taken = slot_valid_i & slot_ready_o;
    reg  f_primary_gone, f_secondary_gone;
    wire [W-1:0] f_left_pixel = {left_blended_o, left_write_o, left_depth_o, left_area_o, left_rgba_o, left_y_o, left_x_o};
    wire [W-1:0] f_right_pixel = {right_blended_o, right_write_o, right_depth_o, right_area_o, right_rgba_o, right_y_o, right_x_o};
    wire [W-1:0] f_a_primary = {1'b0, slot_primary_write_i, slot_primary_depth_i, slot_primary_area_i,
                                slot_primary_rgba_i, slot_primary_y_i, slot_primary_x_i};
    wire [W-1:0] f_a_secondary = {slot_secondary_blended_i, slot_secondary_write_i, slot_secondary_depth_i,
                slot_secondary_area_i, slot_secondary_rgba_i, slot_secondary_y_i, slot_secondary_x_i};

    always @(posedge clk_i) begin
        f_primary_gone   <= ~rst_i & ~f_taken & (f_primary_gone | f_primary);
        f_secondary_gone <= ~rst_i & ~f_taken & (f_secondary_gone | f_secondary);
        // A slot waits as any beat does, except that with two streams a pixel may join it.
        assume (`SAM_WAITS(slot_valid_i, slot_ready_o, {slot_eye_i, single_i}));
        assume (`SAM_WAITS(slot_valid_i & slot_primary_i, slot_ready_o, f_a_primary));
        assume (`SAM_WAITS(slot_valid_i & slot_secondary_i, slot_ready_o, f_a_secondary));
        assume (~single_i | `SAM_WAITS(slot_valid_i, slot_ready_o, {slot_primary_i, slot_secondary_i}));
    end

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits on the left is offered again, unchanged,
        p_left_stable: assert (`SAM_WAITS(left_valid_o, left_ready_i, {left_eye_o, f_left_pixel}));
        // and so is one on the right.
        p_right_stable: assert (`SAM_WAITS(right_valid_o, right_ready_i, {right_eye_o, f_right_pixel}));
        // A slot is taken when each of its pixels has gone.
        p_nothing_lost: assert (rst_i | ~f_taken | ((~slot_primary_i | f_primary | f_primary_gone)
                                          & (~slot_secondary_i | f_secondary | f_secondary_gone)));
        // None goes twice.
        p_nothing_twice: assert (rst_i | ~((f_primary & f_primary_gone) | (f_secondary & f_secondary_gone)
                                   | (f_left & f_right & left_eye_o == right_eye_o)));
        // Only what is there goes.
        p_nothing_made: assert (~((f_primary & ~slot_primary_i) | (f_secondary & ~slot_secondary_i)));
        // What goes to the left is the pixel of the eye that it names,
        p_left: assert (~left_valid_o | f_left_pixel == (left_eye_o == slot_eye_i ? f_a_primary : f_a_secondary));
        // and what goes to the right is.
        p_right: assert (~right_valid_o | f_right_pixel == (right_eye_o == slot_eye_i ? f_a_primary : f_a_secondary));
        // With two streams each has the pixels of its eye.
        p_not_swapped: assert (single_i | ((~left_valid_o | ~left_eye_o) & (~right_valid_o | right_eye_o)));
        // With one stream the right is silent, and the primary goes first.
        p_single: assert (~single_i | (~right_valid_o & (~f_secondary | ~slot_primary_i | f_primary_gone | rst_i)));
        // Where both streams are ready a slot leaves at once, with one stream in the second clock.
        p_prompt: assert (~left_ready_i | ~right_ready_i | slot_ready_o
                          | (single_i & slot_primary_i & ~f_primary_gone));
        // Lemma: the notes are what the ports tell.
        lemma: assert ({primary_gone_q, secondary_gone_q} == {f_primary_gone, f_secondary_gone});
    end
`endif
endmodule

`default_nettype wire
