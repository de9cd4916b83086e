// Integer part of an interpolated value, which may have run past the ends of its range where the
// polygon is extrapolated. Combinational.
// Paper: section 5.5.
`include "sam_formats.vh"
`default_nettype none

module sam_clamp #(
    // Bits of the result: 1 or more. The value has guard bits above and its fraction below.
    parameter BITS = 8
) (
    input  wire [BITS+`SAM_GUARD_BITS+`SAM_FRACTION_BITS-1:0] value_i,
    output wire [BITS-1:0] clamped_o
);
    localparam F = `SAM_FRACTION_BITS;

    generate
        if (BITS < 1) begin : g_illegal
            sam_clamp_BITS_must_be_1_or_more u_error ();
        end
    endgenerate

    localparam G = `SAM_GUARD_BITS;

    wire negative = value_i[F+BITS+G-1];
    wire above    = |value_i[F+BITS +: G-1];

    assign clamped_o = (value_i[F +: BITS] | {BITS{above}}) & {BITS{~negative}};

    wire unused = &{1'b0, value_i[F-1:0]};
endmodule

`default_nettype wire
