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

`ifdef FORMAL
    wire [15:0] f_mask = mask_i;
    always @* begin
        // No sample covers nothing, every sample covers the pixel.
        p_ends: assert ((area_o == 0) == (mask_i == 0) & (area_o == `SAM_FULL_AREA(ANTIALIAS)) == &mask_i);
        // The area is the sum of the samples.
        p_sum: assert (area_o == f_mask[0] + f_mask[1] + f_mask[2] + f_mask[3] + f_mask[4] + f_mask[5]
            + f_mask[6] + f_mask[7] + f_mask[8] + f_mask[9] + f_mask[10] + f_mask[11] + f_mask[12]
            + f_mask[13] + f_mask[14] + f_mask[15]);
    end
`endif
endmodule

`default_nettype wire
