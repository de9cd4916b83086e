//! x
fn main() {
    for t in wheatstone_studies::adelson::run(std::path::Path::new("")).unwrap().tables {
        println!("{t}");
    }
}
