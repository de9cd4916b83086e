// Edge function of the primary pipeline that knows the ends of a row's span: its bound is subtracted
// from it, so that its sign tells the pixels at the end and beyond from those within.
//
// Latency: none from `save_i`; the function moves with `load_i` and `advance_i`.
// Reset: none; a load renews all that is held.
// Paper: section 3 (edge functions of an ordinary rasteriser); docs/theory.md (extended span).
`include "sam_formats.vh"
`default_nettype none

module sam_span_edge #(
    // Fraction bits of a snapped vertex, sets the widths of an edge: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire                                      clk_i,

    input  wire                                      load_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  start_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] a_i,
    input  wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] b_i,
    input  wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  row_i,
    input  wire [`SAM_LOW_BITS-1:0]                  low_i,
    input  wire [`SAM_BOUND_BITS(SUBPIXEL_BITS)-1:0] bound_i,

    // On to the next pixel, or to the next row, there one pixel further than the least.
    input  wire                                      advance_i,
    input  wire                                      down_i,
    input  wire                                      move_i,
    // The row starts here.
    input  wire                                      save_i,

    // The row starts not right of here; nor right of the least movement into the next row.
    output wire                                      starts_o,
    output wire                                      next_starts_o,
    // The row ends not right of here.
    output wire                                      beyond_o,

    output wire [`SAM_EDGE_BITS(SUBPIXEL_BITS)-1:0]  value_o,
    output wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] a_o,
    output wire [`SAM_SLOPE_BITS(SUBPIXEL_BITS)-1:0] b_o,
    output wire [`SAM_LOW_BITS-1:0]                  low_o
);
    localparam E = `SAM_EDGE_BITS(SUBPIXEL_BITS);
    localparam S = `SAM_SLOPE_BITS(SUBPIXEL_BITS);
    localparam B = `SAM_BOUND_BITS(SUBPIXEL_BITS);

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_span_edge_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    reg [E-1:0]             inner_q;
    reg [E-1:0]             saved_q;
    reg [E-1:0]             row_q;
    reg [S-1:0]             a_q;
    reg [S-1:0]             b_q;
    reg [`SAM_LOW_BITS-1:0] low_q;
    reg [B-1:0]             bound_q;
    reg                     rises_q;

    // The next row, one pixel right of the least movement; without `move_i` it goes one back.
    wire [E-1:0] start = save_i ? inner_q : saved_q;
    wire [E-1:0] ahead = start + row_q;
    wire [E-1:0] a     = {{(E - S){a_q[S-1]}}, a_q};
    wire [E-1:0] from  = down_i ? ahead : inner_q;
    wire [E-1:0] by    = down_i ? (move_i ? {E{1'b0}} : ~a) : a;
    wire         carry = down_i & ~move_i;

    always @(posedge clk_i) begin
        if (load_i) begin
            inner_q <= start_i;
            row_q   <= row_i;
            a_q     <= a_i;
            b_q     <= b_i;
            low_q   <= low_i;
            bound_q <= bound_i;
            rises_q <= ~a_i[S-1] & (a_i != {S{1'b0}});
        end else if (advance_i) begin
            inner_q <= from + by + {{(E - 1){1'b0}}, carry};
        end
        if (advance_i & save_i) saved_q <= inner_q;
    end

    assign starts_o      = rises_q & inner_q[E-1];
    assign next_starts_o = rises_q & ahead[E-1];
    assign beyond_o      = a_q[S-1] & inner_q[E-1];
    assign value_o       = inner_q + {{(E - B){bound_q[B-1]}}, bound_q};
    assign a_o           = a_q;
    assign b_o           = b_q;
    assign low_o         = low_q;

`ifdef FORMAL
    // The function without its bound, its values at the row start and at the row's first pixel.
    wire signed [E-1:0] f_bound = $signed(bound_q);
    reg  signed [S-1:0] f_slope;
    reg  [E-1:0] f_saved, f_row;
    wire signed [E-1:0] f_bound_in = $signed(bound_i);
    wire [E-1:0] f_inner = value_o - f_bound;
    wire [E-1:0] f_ahead = (save_i ? f_inner : f_saved) + f_row;
    wire signed [E-1:0] f_a = f_slope;

    always @(posedge clk_i) begin
        if (load_i) {f_slope, f_row} <= {a_i, row_i};
        if (advance_i & save_i) f_saved <= f_inner;
        assume (~load_i | ~advance_i);
    end
    reg f_loaded = 1'b0;
    always @(posedge clk_i) f_loaded <= f_loaded | load_i;
    always @* assume (f_loaded | f_saved == saved_q);

    always @(posedge clk_i) begin
        if (f_loaded & $past(f_loaded)) begin
            // Until the next load the function stays where nothing advances.
            p_stays: assert ($past(load_i | advance_i) | $stable(value_o));
            // Within a row it moves by a.
            p_steps: assert ($past(load_i | ~advance_i | down_i) | value_o == $past(value_o + f_a));
            // Into the next row it moves from the row start by the increment, or by a pixel less.
            p_rows: assert ($past(load_i | ~advance_i | ~down_i)
                            | value_o == $past((move_i ? f_ahead : f_ahead - f_a) + f_bound));
        end
        // A load gives start and bound, slopes and low bits.
        p_loads: assert (~f_loaded | ~$past(load_i)
            | (value_o == $past(start_i + f_bound_in) & {a_o, b_o, low_o} == $past({a_i, b_i, low_i})));
        if (f_loaded) begin
            // A row starts at a rising edge's pixels that are below its bound,
            p_starts: assert (starts_o == (f_slope > 0 & $signed(f_inner) < 0));
            // the next one where the increment leads below it,
            p_next: assert (next_starts_o == (f_slope > 0 & $signed(f_ahead) < 0));
            // and ends at a falling edge's.
            p_beyond: assert (beyond_o == (f_slope < 0 & $signed(f_inner) < 0));
            // Lemma: registers are what the ports tell.
            lemma: assert ({saved_q, row_q, a_q} == {f_saved, f_row, f_slope} & rises_q == (f_slope > 0));
        end
    end
`endif
endmodule

`default_nettype wire
