// What the properties at the ends of the modules share. Read by provers only.
`ifndef SAM_FORMAL_VH
`define SAM_FORMAL_VH

// The first clock is one of reset, after which f_begun is high; a later reset may come at any time.
`define SAM_BEGIN \
    reg f_begun = 1'b0; \
    always @(posedge clk_i) f_begun <= 1'b1; \
    always @* assume (f_begun | rst_i);

// In a clocked block: a beat that was not taken is offered again, unchanged.
`define SAM_WAITS(valid, ready, payload) \
    (~f_begun | $past(~f_begun | rst_i | ~(valid) | (ready)) | ((valid) & $stable(payload)))

// Whether a beat is inside, told from what was taken and given.
`define SAM_HELD(name, taken, given) \
    reg name; \
    always @(posedge clk_i) name <= ~rst_i & ((taken) | (name & ~(given)));

`endif
