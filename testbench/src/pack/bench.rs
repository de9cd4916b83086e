//! The files that replay a pack in any Verilog simulator: `vec.vh` and `replay.v`.

use super::beats::packed_fields;
use super::{Manifest, PackedField};
use std::fmt::Write;
use wheatstone_golden::header::formats_header;
use wheatstone_golden::interface::{Direction, Field, Interface, Stream};

/// The files that replay a pack, by name.
pub fn files(manifest: &Manifest, interface: &Interface) -> [(&'static str, String); 3] {
    [
        ("vec.vh", header(manifest, interface)),
        (BENCH, bench(interface)),
        // The Verilog includes it, and `-I PACK` is all that a simulator is told.
        ("sam_formats.vh", formats_header()),
    ]
}

/// The bench.
pub(super) const BENCH: &str = "replay.v";

/// The macros of `vec.vh`.
fn header(manifest: &Manifest, interface: &Interface) -> String {
    // No text of the manifest that is not a name of the interface or a number.
    let mut text = format!("// Generated; do not edit. Vectors of {}.\n", interface.module);
    text += "`ifndef VEC_VH\n`define VEC_VH\n";
    let parameters: Vec<String> =
        interface.parameters.iter().map(|(name, value)| format!(".{name}({value})")).collect();
    define(&mut text, "VEC_MODULE", interface.module);
    // A netlist has its parameters built in.
    if !parameters.is_empty() {
        text += "`ifdef NETLIST\n`define VEC_PARAMETERS\n`else\n";
        define(&mut text, "VEC_PARAMETERS", &format!("#({})", parameters.join(", ")));
        text += "`endif\n";
    }
    let statics = manifest.statics.iter().zip(&interface.statics);
    for (value, field) in statics.chain(manifest.flags.iter().zip(&interface.flags)) {
        define(&mut text, &macro_name(field.name, ""), &literal(field, value.value));
    }
    for (port, stream) in manifest.ports.iter().zip(&interface.streams) {
        define(&mut text, &macro_name(stream.name, "BITS"), &port.bits.to_string());
        define(&mut text, &macro_name(stream.name, "BYTES"), &port.bytes.to_string());
        define(&mut text, &macro_name(stream.name, "BEATS"), &port.beats.to_string());
        define(&mut text, &macro_name(stream.name, "CRC"), &format!("32'h{}", port.crc32));
    }
    text + "`endif\n"
}

fn define(text: &mut String, name: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "`define {name} {value}");
}

fn macro_name(name: &str, what: &str) -> String {
    let parts = ["VEC", name, what].into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("_").to_uppercase()
}

fn literal(field: &Field, value: u64) -> String {
    format!("{}'d{value}", field.bits)
}

/// The bench: offers every input beat, takes every output beat and compares it.
fn bench(interface: &Interface) -> String {
    let mut text = BENCH_HEAD.replace("@MODULE@", interface.module);
    let mut connections = vec![".clk_i(clk)".to_owned(), ".rst_i(rst)".to_owned()];
    for field in &interface.statics {
        connections.push(format!(".{0}_i(`VEC_{1})", field.name, field.name.to_uppercase()));
    }
    let mut done = Vec::new();
    let mut checks = String::new();
    for field in &interface.flags {
        let range = range(field.bits);
        let _ = writeln!(text, "  wire {range}{0};", field.name);
        connections.push(format!(".{0}_o({0})", field.name));
        let upper = field.name.to_uppercase();
        let _ = writeln!(
            checks,
            "      if ({0} !== `VEC_{upper}) begin\n        $display(\"flag {0}: %0d, expected %0d\", {0}, `VEC_{upper});\n        faults = faults + 1;\n      end",
            field.name
        );
    }
    for stream in &interface.streams {
        let template = match stream.direction {
            Direction::Input => INPUT,
            Direction::Output => OUTPUT,
        };
        let name = stream.name;
        let gate = stream.answers.map_or("1'b1".to_owned(), |r| format!("{name}_n < {r}_n"));
        let upper = name.to_uppercase();
        text += &template.replace("@P@", name).replace("@U@", &upper).replace("@GATE@", &gate);
        connect(stream, &mut connections);
        done.push(format!("{name}_n == `VEC_{upper}_BEATS"));
        if stream.direction == Direction::Output {
            checks += &CHECK.replace("@P@", name).replace("@U@", &upper);
        }
    }
    let parameters = if interface.parameters.is_empty() { "" } else { "`VEC_PARAMETERS " };
    let _ = writeln!(
        text,
        "  `VEC_MODULE {parameters}dut (\n    {}\n  );\n",
        connections.join(",\n    ")
    );
    let _ = writeln!(text, "  wire done = {};", done.join("\n    && "));
    text + &BENCH_TAIL.replace("@CHECKS@", checks.trim_end())
}

fn range(bits: u32) -> String {
    if bits == 1 {
        String::new()
    } else {
        format!("[{}:0] ", bits - 1)
    }
}

fn connect(stream: &Stream, connections: &mut Vec<String>) {
    let (own, back) = match stream.direction {
        Direction::Input => ("i", "o"),
        Direction::Output => ("o", "i"),
    };
    let p = stream.name;
    connections.push(format!(".{p}_valid_{own}({p}_valid)"));
    connections.push(format!(".{p}_ready_{back}({p}_ready)"));
    for PackedField { name, lsb, bits, .. } in packed_fields(&stream.fields) {
        let top = lsb + bits - 1;
        connections.push(format!(".{p}_{name}_{own}({p}_beat[{top}:{lsb}])"));
    }
}

const BENCH_HEAD: &str = r#"// Generated; replays a vector pack on @MODULE@ and prints PASS or FAIL.
//   iverilog -g2005 -I PACK -o t PACK/replay.v rtl/*.v && vvp t
// With -DNETLIST the module is a gate-level netlist, without parameters.
// Plusargs: +stall=0 offers and takes a beat on every clock; +pack=DIR names the pack's folder where
// the simulator does not know where this file lies; +dump=FILE writes a VCD.
// After FAIL, and if there are no vectors, Icarus ends with status 1 and Verilator aborts.
`include "vec.vh"
`ifdef __ICARUS__
`define VEC_FAIL $finish_and_return(1)
`else
`ifdef VERILATOR
`define VEC_FAIL $stop
`else
`define VEC_FAIL $finish
`endif
`endif
module replay;
  reg clk = 1'b0;
  reg rst = 1'b1;
  always #5 clk = ~clk;

  integer faults = 0;
  integer idle = 0;
  integer found;
  reg moved = 1'b0;
  reg [31:0] stall = 32'd1;
  reg [31:0] noise = 32'h1234_5678;
  reg [8*1024-1:0] pack;
  reg [8*1024-1:0] dump;

  // Four independent bits of a xorshift generator a stream and clock.
  function [31:0] next_noise(input [31:0] x);
    reg [31:0] y;
    begin
      y = x ^ (x << 13);
      y = y ^ (y >> 17);
      next_noise = y ^ (y << 5);
    end
  endfunction

  // CRC-32/ISO-HDLC of one byte.
  function [31:0] crc_byte(input [31:0] crc, input [7:0] data);
    integer k;
    begin
      crc_byte = crc ^ {24'd0, data};
      for (k = 0; k < 8; k = k + 1)
        crc_byte = crc_byte[0] ? (crc_byte >> 1) ^ 32'hEDB88320 : crc_byte >> 1;
    end
  endfunction

  initial begin
    if (!$value$plusargs("stall=%d", stall)) stall = 32'd1;
    // The folder of this file, found by dropping the eight letters of its name.
    if (!$value$plusargs("pack=%s", pack)) begin
      pack = `__FILE__;
      pack = pack >> 64;
    end else pack = {pack, "/"};
    found = $fopen({pack, "vec.vh"}, "r");
    if (found == 0) begin
      $display("error: no vectors in %0s: name the pack's folder with +pack=DIR; if its name has other than", pack);
      $display("ASCII letters, or a backslash, run this in the folder itself with +pack=.");
      `VEC_FAIL;
    end else $fclose(found);
    if ($value$plusargs("dump=%s", dump)) begin
      $dumpfile(dump);
      $dumpvars(0, replay);
    end
    #42 rst = 1'b0;
  end

  always @(posedge clk) noise <= next_noise(noise);

"#;

const INPUT: &str = r#"  // Input stream @P@.
  reg [`VEC_@U@_BITS-1:0] @P@_mem [0:`VEC_@U@_BEATS];
  integer @P@_n = 0;
  reg @P@_valid = 1'b0;
  wire @P@_ready;
  wire [`VEC_@U@_BITS-1:0] @P@_beat = @P@_valid ? @P@_mem[@P@_n] : {`VEC_@U@_BITS{1'bx}};
  reg [31:0] @P@_noise = 32'd0;
  initial begin
    #1 @P@_mem[`VEC_@U@_BEATS] = 0;
    if (`VEC_@U@_BEATS > 0) $readmemh({pack, "@P@.mem"}, @P@_mem, 0, `VEC_@U@_BEATS - 1);
  end
  // Offered between edges, kept until taken.
  always @(negedge clk) if (!rst) begin
    @P@_noise = next_noise(noise + 32'h9E37_79B9 + @P@_n);
    if (!@P@_valid && @P@_n < `VEC_@U@_BEATS && @GATE@ && (stall == 0 || @P@_noise[3:2] != 0))
      @P@_valid <= 1'b1;
  end
  always @(posedge clk) if (!rst && @P@_valid && @P@_ready) begin
    @P@_n <= @P@_n + 1;
    @P@_valid <= 1'b0;
    moved = 1'b1;
  end

"#;

const OUTPUT: &str = r#"  // Output stream @P@.
  reg [`VEC_@U@_BITS-1:0] @P@_mem [0:`VEC_@U@_BEATS];
  integer @P@_n = 0;
  integer @P@_k;
  wire @P@_valid;
  reg @P@_ready = 1'b0;
  wire [`VEC_@U@_BITS-1:0] @P@_beat;
  reg [8*`VEC_@U@_BYTES-1:0] @P@_padded;
  reg [31:0] @P@_crc = 32'hFFFF_FFFF;
  reg [31:0] @P@_noise = 32'd0;
  initial begin
    #1 @P@_mem[`VEC_@U@_BEATS] = 0;
    if (`VEC_@U@_BEATS > 0) $readmemh({pack, "@P@.mem"}, @P@_mem, 0, `VEC_@U@_BEATS - 1);
  end
  always @(negedge clk) if (!rst) begin
    @P@_noise = next_noise(noise + 32'h7F4A_7C15 + @P@_n);
    @P@_ready <= stall == 0 || @P@_noise[5:4] != 0;
  end
  always @(posedge clk) if (!rst && @P@_valid && @P@_ready) begin
    if (@P@_n >= `VEC_@U@_BEATS || @P@_beat !== @P@_mem[@P@_n]) begin
      if (faults < 10)
        $display("@P@ beat %0d: %h, expected %h", @P@_n, @P@_beat, @P@_mem[@P@_n]);
      faults = faults + 1;
    end
    @P@_padded = @P@_beat;
    for (@P@_k = 0; @P@_k < `VEC_@U@_BYTES; @P@_k = @P@_k + 1)
      @P@_crc = crc_byte(@P@_crc, @P@_padded[8*@P@_k +: 8]);
    @P@_n = @P@_n + 1;
    moved = 1'b1;
  end

"#;

const CHECK: &str = r#"      $display("crc @P@ %h, expected %h, %0d of %0d beats", ~@P@_crc, `VEC_@U@_CRC, @P@_n, `VEC_@U@_BEATS);
      if (~@P@_crc !== `VEC_@U@_CRC || @P@_n != `VEC_@U@_BEATS) faults = faults + 1;
"#;

const BENCH_TAIL: &str = r#"
  // Some quiet clocks after the last beat show beats that should not come; without any beat for
  // long, the module hangs; with so many differences it may never end.
  always @(posedge clk) begin
    #1 idle = moved ? 0 : idle + 1;
    moved = 1'b0;
    if ((done && idle > 64) || idle > 20000 || faults > 1000) begin
      if (idle > 20000) begin
        $display("no beat for %0d clocks, streams unfinished", idle);
        faults = faults + 1;
      end
@CHECKS@
      if (faults == 0) begin
        $display("PASS");
        $finish;
      end else begin
        $display("FAIL (%0d differences)", faults);
        `VEC_FAIL;
      end
    end
  end
endmodule
"#;
