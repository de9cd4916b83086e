//! The program `wheatstone`; see [`wheatstone_testbench::cli`].

fn main() -> std::process::ExitCode {
    wheatstone_testbench::cli::main()
}
