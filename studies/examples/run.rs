//! r
fn main() {
    let out = std::path::PathBuf::from("/tmp/study");
    std::fs::create_dir_all(&out).unwrap();
    for e in wheatstone_studies::EXPERIMENTS {
        if std::env::args().nth(1).is_some_and(|n| n != e.name) {
            continue;
        }
        let t = std::time::Instant::now();
        let r = (e.run)(&out).unwrap();
        for t in &r.tables {
            println!("{t}");
        }
        println!("{:?} {:.1?}", r.files, t.elapsed());
        for d in r.differing() {
            println!("DIFFERS {}", d.what);
        }
    }
}
