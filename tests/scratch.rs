use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Beat;
use wheatstone_golden::pipeline::{Request, Setup};
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases;
#[test]
fn s() {
    for case in cases::directed(Target::Hybrid, &Config::DEFAULT)
        .into_iter()
        .chain((1..8).map(|s| cases::random(Target::Hybrid, &Config::DEFAULT, s, 5600)))
    {
        let i = case.interface();
        let n: Vec<_> = i.streams.iter().filter(|s| s.name != "x").map(|s| s.name).collect();
        println!(
            "{} {:?} in {:?} out {:?}",
            case.name,
            n,
            case.inputs.iter().map(|t| t.len()).collect::<Vec<_>>(),
            case.outputs.iter().map(|t| t.len()).collect::<Vec<_>>()
        );
        let mut m = [0; 8];
        for k in 0..case.inputs[0].len() {
            m[Setup::read(case.inputs[0].row(k)).mode.0 as usize & 7] += 1;
        }
        println!("modes {m:?}");
        let req = &case.outputs[0];
        let mut near = 0;
        for k in 0..req.len() {
            let r = Request::read(req.row(k));
            for j in k.saturating_sub(8)..k {
                if Request::read(req.row(j)) == r {
                    near += 1;
                    break;
                }
            }
        }
        println!("requests {} with the same within 8: {near}", req.len());
    }
}
