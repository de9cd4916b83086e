// Division of the filter's sum of one channel by n. Combinational.
// Paper: section 5.6.1, equation 1 and figure 6.
`include "sam_formats.vh"
`default_nettype none

module sam_filter_division #(
    // 2 or 3: 1/n as so many powers of two. 0: by a reciprocal, with the rounding in the sum.
    parameter FILTER_TERMS = 0
) (
    input  wire [12:0]                sum_i,
    input  wire [`SAM_COUNT_BITS-1:0] count_i,
    input  wire [17:0]                factor_i,
    output wire [7:0]                 quotient_o
);
    generate
        if (FILTER_TERMS != 0 && FILTER_TERMS != 2 && FILTER_TERMS != 3) begin : g_illegal
            sam_filter_division_FILTER_TERMS_must_be_0_or_2_or_3 u_error ();
        end
        if (FILTER_TERMS == 0) begin : g_exact
            wire [30:0] product = {18'd0, sum_i} * {13'd0, factor_i};
            assign quotient_o = product[`SAM_RECIPROCAL_SHIFT +: 8];
            wire unused = &{1'b0, count_i, product[30:26], product[17:0]};
        end else if (FILTER_TERMS == 2) begin : g_two_terms
            // sum (2^-p + 2^-q) is (sum + sum 2^-d) 2^-p with d = q - p: a short adder between two
            // short shifters. Bits below 2^-d cannot carry, as the other addend has none there.
            localparam [127:0] P = `SAM_TWO_TERM_P;
            localparam [127:0] Q = `SAM_TWO_TERM_Q;

            wire [3:0]  p      = P[{count_i, 2'b00} +: 4];
            wire [3:0]  d      = Q[{count_i, 2'b00} +: 4] - p;
            wire [12:0] second = sum_i >> d[2:0];
            wire [13:0] total  = {1'b0, sum_i} + {1'b0, second};
            // With one fraction bit, for the rounding.
            wire [14:0] scaled  = {total, 1'b0} >> p[2:0];
            wire [8:0]  rounded = scaled[9:1] + {8'd0, scaled[0]};

            assign quotient_o = rounded[7:0] | {8{rounded[8]}};
            wire unused = &{1'b0, scaled[14:10], p[3], d[3], factor_i};
        end else begin : g_three_terms
            localparam SHIFT = `SAM_THREE_TERM_SHIFT;
            localparam [127:0] P = `SAM_THREE_TERM_P;
            localparam [127:0] Q = `SAM_THREE_TERM_Q;
            localparam [127:0] R = `SAM_THREE_TERM_R;
            localparam T = 13 + SHIFT;

            // No exponent exceeds SHIFT: nothing is lost before the sum is rounded.
            wire [T-1:0] scaled = {sum_i, {SHIFT{1'b0}}};
            wire [T-1:0] total  = (scaled >> P[{count_i, 2'b00} +: 4])
                                + (scaled >> Q[{count_i, 2'b00} +: 4])
                                + (scaled >> R[{count_i, 2'b00} +: 4])
                                + {13'd0, 1'b1, {(SHIFT - 1){1'b0}}};
            assign quotient_o = total[SHIFT +: 8] | {8{total[SHIFT + 8]}};
            wire unused = &{1'b0, total[T-1:SHIFT+9], total[SHIFT-1:0], factor_i};
        end
    endgenerate
endmodule

`default_nettype wire
