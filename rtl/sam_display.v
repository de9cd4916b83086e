// Place of a secondary pixel on the display: mirrored and turned displays such as the Cyberscope.
//
// Latency: one clock.
// Reset: rst_i clears valid_q only.
// Paper: section 5.2.
`include "sam_formats.vh"
`default_nettype none

module sam_display #(
    // Fraction bits of a snapped vertex, sets the width of a coordinate: 4 or 8.
    parameter SUBPIXEL_BITS = 8
) (
    input  wire                                           clk_i,
    input  wire                                           rst_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] width_i,

    input  wire                                           point_valid_i,
    output wire                                           point_ready_o,
    input  wire [`SAM_PIXEL_X_BITS(SUBPIXEL_BITS)-1:0]    point_x_i,
    input  wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] point_y_i,
    input  wire                                           point_swap_i,
    input  wire                                           point_mirror_i,

    output wire                                           pixel_valid_o,
    input  wire                                           pixel_ready_i,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_x_o,
    output wire [`SAM_COORDINATE_BITS(SUBPIXEL_BITS)-1:0] pixel_y_o
);
    localparam C = `SAM_COORDINATE_BITS(SUBPIXEL_BITS);
    localparam P = `SAM_PIXEL_X_BITS(SUBPIXEL_BITS);

    generate
        if (SUBPIXEL_BITS != 4 && SUBPIXEL_BITS != 8) begin : g_illegal
            sam_display_SUBPIXEL_BITS_must_be_4_or_8 u_error ();
        end
    endgenerate

    reg         valid_q;
    reg [C-1:0] x_q;
    reg [C-1:0] y_q;

    // width - 1 - x is width + ~x. The sign of x is dropped: a negative x is outside and is
    // never drawn.
    wire [C-1:0] from_right = width_i + ~point_x_i[C-1:0];
    wire [C-1:0] column     = point_mirror_i ? from_right : point_x_i[C-1:0];

    generate
        if (P > C) begin : g_sign
            wire unused = &{1'b0, point_x_i[P-1:C]};
        end
    endgenerate

    assign point_ready_o = ~valid_q | pixel_ready_i;

    always @(posedge clk_i) begin
        if (rst_i)              valid_q <= 1'b0;
        else if (point_ready_o) valid_q <= point_valid_i;

        if (point_valid_i & point_ready_o) begin
            x_q <= point_swap_i ? point_y_i : column;
            y_q <= point_swap_i ? column : point_y_i;
        end
    end

    assign pixel_valid_o = valid_q;
    assign pixel_x_o     = x_q;
    assign pixel_y_o     = y_q;

`ifdef FORMAL
`include "sam_formal.vh"
    `SAM_BEGIN
    // The point inside, and its place, told from the ports.
    wire f_take = point_valid_i & point_ready_o;
    wire f_give = pixel_valid_o & pixel_ready_i;
    `SAM_HELD(f_held, f_take, f_give)
    reg signed [P:0] f_x, f_y, f_width;
    reg              f_swap, f_mirror;
    wire signed [P:0] f_column = f_mirror ? f_width - 1 - f_x : f_x;

    always @(posedge clk_i) if (f_take) begin
        {f_swap, f_mirror} <= {point_swap_i, point_mirror_i};
        f_x     <= $signed(point_x_i);
        f_y     <= point_y_i;
        f_width <= width_i;
    end

    always @(posedge clk_i) if (f_begun) begin
        // A pixel that waits is offered again, unchanged.
        p_stable: assert (`SAM_WAITS(pixel_valid_o, pixel_ready_i, {pixel_x_o, pixel_y_o}));
        // No point is taken before the one inside has left.
        p_nothing_lost: assert (~(f_take & f_held & ~f_give));
        // A pixel is offered exactly when a point is inside.
        p_nothing_twice: assert (pixel_valid_o == f_held);
        // A point within the view keeps its distance from the left or, mirrored, from the right.
        p_column: assert (~f_held | f_x < 0 | f_x >= f_width
                        | (f_swap ? pixel_y_o : pixel_x_o) == f_column);
        // The row is that of the point.
        p_row: assert (~f_held | (f_swap ? pixel_x_o : pixel_y_o) == f_y);
        // Lemma: outside too, the column is what the low bits say.
        lemma: assert (~f_held | (f_swap ? pixel_y_o : pixel_x_o) == f_column[C-1:0]);
    end
`endif
endmodule

`default_nettype wire
