//! Prints `rtl/sam_formats.vh`.

fn main() {
    print!("{}", wheatstone_golden::header::formats_header());
}
