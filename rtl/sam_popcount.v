// Covered area: the number of ones of a coverage mask. Combinational.
// Paper: section 5.4.
`include "sam_formats.vh"
`default_nettype none

module sam_popcount #(
    // 16 coverage samples a pixel instead of one: 0 or 1.
    parameter ANTIALIAS = 0
) (
    input  wire [`SAM_MASK_BITS(ANTIALIAS)-1:0] mask_i,
    output wire [`SAM_AREA_BITS(ANTIALIAS)-1:0] area_o
);
    generate
        if (ANTIALIAS != 0 && ANTIALIAS != 1) begin : g_illegal
            sam_popcount_ANTIALIAS_must_be_0_or_1 u_error ();
        end
        if (ANTIALIAS == 0) begin : g_whole
            assign area_o = mask_i;
        end else begin : g_samples
            reg [4:0] ones;
            integer   i;

            always @* begin
                ones = 5'd0;
                for (i = 0; i < 16; i = i + 1) ones = ones + {4'd0, mask_i[i]};
            end
            assign area_o = ones;
        end
    endgenerate
endmodule

`default_nettype wire
