// Number formats of the SAM hardware: widths in bits, codes, limits and filter tables.
// Generated from golden/src/{config,formats}.rs and golden/src/pipeline/ by
//     cargo run -p wheatstone-testbench -- generate
// Do not edit.
//
// SUB stands for the parameter SUBPIXEL_BITS, AA for ANTIALIAS.
`ifndef SAM_FORMATS_VH
`define SAM_FORMATS_VH

// Widths
// SecondaryX: signed, 14 fraction bits
`define SAM_X_BITS(SUB) ((SUB) == 8 ? 27 : 25)
// Scale: unsigned, 14 fraction bits
`define SAM_SCALE_BITS 15
// Slant: signed, 14 fraction bits
`define SAM_SLANT_BITS 16
// PixelX: signed integer
`define SAM_PIXEL_X_BITS(SUB) ((SUB) == 8 ? 13 : 11)
// Coordinate: unsigned integer
`define SAM_COORDINATE_BITS(SUB) ((SUB) == 8 ? 12 : 11)
// DisplayStep: signed integer
`define SAM_DISPLAY_STEP_BITS 3
// Move: signed integer
`define SAM_MOVE_BITS 2
// EdgeValue: signed integer
`define SAM_EDGE_BITS(SUB) ((SUB) == 8 ? 34 : 26)
// Slope: signed integer
`define SAM_SLOPE_BITS(SUB) ((SUB) == 8 ? 22 : 16)
// Bound: signed integer
`define SAM_BOUND_BITS(SUB) ((SUB) == 8 ? 28 : 22)
// LowBits: unsigned integer
`define SAM_LOW_BITS 3
// DepthPlane: signed, 14 fraction bits
`define SAM_DEPTH_PLANE_BITS 43
// ColourPlane: signed, 14 fraction bits
`define SAM_COLOUR_PLANE_BITS 27
// Depth: unsigned integer
`define SAM_DEPTH_BITS 24
// Area: unsigned integer
`define SAM_AREA_BITS(AA) ((AA) == 1 ? 5 : 1)
// Mask: unsigned integer
`define SAM_MASK_BITS(AA) ((AA) == 1 ? 16 : 1)
// Count: unsigned integer
`define SAM_COUNT_BITS 5
// Fraction bits of the quantities that have a fraction
`define SAM_FRACTION_BITS 14
// Integer bits of a depth or colour plane beyond the range of the attribute
`define SAM_GUARD_BITS 5
// Op of a beat
`define SAM_OP_BITS 2
// Mode of a polygon
`define SAM_MODE_BITS 3
// Colour with alpha, red in the lowest byte
`define SAM_RGBA_BITS 32
// Colour without alpha
`define SAM_RGB_BITS 24
// One channel of a colour
`define SAM_CHANNEL_BITS 8

// Codes
`define SAM_OP_LOAD 2'd0
`define SAM_OP_STEP 2'd1
`define SAM_OP_ROW 2'd2
`define SAM_OP_RESERVED 2'd3
`define SAM_MODE_MONO_LEFT 3'd0
`define SAM_MODE_MONO_RIGHT 3'd1
`define SAM_MODE_LEFT_TO_RIGHT 3'd2
`define SAM_MODE_RIGHT_TO_LEFT 3'd3

// Limits
// 1.0 as a Scale, the largest legal G1
`define SAM_SCALE_ONE 16384
// Smallest legal G1
`define SAM_SCALE_MIN 565
// Largest width and height of a view
`define SAM_MAX_SIZE(SUB) ((SUB) == 8 ? 2048 : 640)
// Pixels around a view in which polygons are left unclipped
`define SAM_GUARD_BAND(SUB) ((SUB) == 8 ? 1024 : 192)
// Pixels around the guard band in which a start is accepted
`define SAM_START_SLACK 64
// Samples of a fully covered pixel
`define SAM_FULL_AREA(AA) ((AA) == 1 ? 16 : 1)
// Largest depth
`define SAM_DEPTH_MAX 16777215
// Most pixels the filter averages
`define SAM_FILTER_LIMIT 29

// Filter tables: entry n is the part-select [n*<table>_BITS +: <table>_BITS]
// 1/n as 2^-P + 2^-Q
`define SAM_TWO_TERM_SHIFT 8
`define SAM_TWO_TERM_P_BITS 4
`define SAM_TWO_TERM_P 128'h00555555555555554444444433332210
`define SAM_TWO_TERM_Q_BITS 4
`define SAM_TWO_TERM_Q 128'h00888777666665558766554465434210
// 1/n as 2^-P + 2^-Q + 2^-R
`define SAM_THREE_TERM_SHIFT 11
`define SAM_THREE_TERM_P_BITS 4
`define SAM_THREE_TERM_P 128'h00555655565555554454544433332210
`define SAM_THREE_TERM_Q_BITS 4
`define SAM_THREE_TERM_Q 128'h00988677766666668756555565444320
`define SAM_THREE_TERM_R_BITS 4
`define SAM_THREE_TERM_R 128'h00ab97a986a88766ba68576597646320
// ceil(2^SHIFT / n), so wide that no multiplication is in an index
`define SAM_RECIPROCAL_SHIFT 18
`define SAM_RECIPROCAL_BITS 32
`define SAM_RECIPROCAL 1024'h00000000000000000000235000002493000025ee00002763000028f600002aab00002c8600002e8c000030c400003334000035e6000038e400003c3d00004000000044450000492500004ec50000555600005d1800006667000071c8000080000000924a0000aaab0000cccd0001000000015556000200000004000000000000

`endif
