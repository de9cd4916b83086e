use fastrand::Rng;
use wheatstone_golden::clipping::{lines, polygons, Point, Window};
use wheatstone_golden::faces::*;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::simultaneous::{flat, gouraud, projection::Projector, Corner, Edges};
use wheatstone_golden::work::*;
use wheatstone_studies::timing::ratio;

fn poly<const N: usize>(r: &mut Rng, sides: usize, reach: [f64; 2]) -> Vec<Corner<2, N>> {
    let c = [128.0, 128.0];
    let scale = 0.8 + 0.3 * r.f64();
    let shear = r.f64() * 0.2 - 0.1;
    let turn = r.f64() * 6.0;
    (0..sides)
        .map(|k| {
            let a = turn + (k as f64 + 0.6 * r.f64()) / sides as f64 * 6.2831853;
            let d = [a.cos() * reach[0], a.sin() * reach[1]];
            Corner {
                x: [c[0] + d[0], c[0] + 5.0 + scale * d[0] + shear * d[1]]
                    .map(|n| (n * 256.0) as i32),
                y: ((c[1] + d[1]) * 256.0) as i32,
                values: [(); N].map(|_| r.i32(0..256)),
            }
        })
        .collect()
}
fn views<const N: usize>(p: &[Vec<Corner<2, N>>]) -> [Vec<Vec<Corner<1, N>>>; 2] {
    [0, 1].map(|v| p.iter().map(|p| p.iter().map(|c| c.view(v)).collect()).collect())
}
fn main() {
    let rounds = 201;
    let mut r = Rng::with_seed(1);
    let points: Vec<[f64; 3]> =
        (0..4096).map(|_| [r.f64() * 20.0 - 10.0, r.f64() * 20.0 - 10.0, r.f64() * 50.0]).collect();
    let pr = Projector::new(6.5, 60.0);
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    let x = ratio(
        rounds,
        || {
            a.clear();
            a.extend(points.iter().map(|&p| pr.one(p, Eye::Left)));
            b.clear();
            b.extend(points.iter().map(|&p| pr.one(p, Eye::Right)));
            (a.len(), b.len())
        },
        || {
            c.clear();
            c.extend(points.iter().map(|&p| pr.both(p)));
            c.len()
        },
    );
    println!("projection {:.3} {:?} {:?}", x.median, x.first, x.second);
    let planes: Vec<Plane<f64>> =
        (0..4096).map(|_| Plane([(); 4].map(|_| r.f64() * 2.0 - 1.0))).collect();
    let v = Viewer::new(6.5, 60.0);
    let left = [v.right[0] - v.separation, 0.0, v.right[2]];
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    let x = ratio(
        rounds,
        || {
            a.clear();
            a.extend(planes.iter().map(|p| p.faces(left)));
            b.clear();
            b.extend(planes.iter().map(|p| p.faces(v.right)));
            (a.len(), b.len())
        },
        || {
            c.clear();
            c.extend(planes.iter().map(|p| v.facing(p).front()));
            c.len()
        },
    );
    println!("faces {:.3} {:?} {:?}", x.median, x.first, x.second);
    let x = ratio(
        rounds,
        || {
            a.clear();
            a.extend(planes.iter().map(|p| p.faces(left)));
            b.clear();
            b.extend(planes.iter().map(|p| p.faces(v.right)));
            (a.len(), b.len())
        },
        || {
            c.clear();
            c.extend(planes.iter().map(|p| v.decide(p)));
            c.len()
        },
    );
    println!("faces decide {:.3} {:?} {:?}", x.median, x.first, x.second);
    let w = Window { x: [0.0, 256.0], y: [0.0, 256.0] };
    let mut pt = |r: &mut Rng| {
        let x = r.f64() * 1280.0 - 320.0;
        Point { x: [x, x + r.f64() * 30.0 - 15.0], y: r.f64() * 960.0 - 240.0 }
    };
    let ls: Vec<[Point<f64, 2>; 2]> = (0..4096).map(|_| [pt(&mut r), pt(&mut r)]).collect();
    let s: [Vec<_>; 2] = [0, 1].map(|v| ls.iter().map(|l| l.map(|p| p.view(v))).collect());
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    let x = ratio(
        rounds,
        || {
            a.clear();
            a.extend(s[0].iter().map(|l| lines::clip(l, &w, &mut Unmetered)));
            b.clear();
            b.extend(s[1].iter().map(|l| lines::clip(l, &w, &mut Unmetered)));
            (a.len(), b.len())
        },
        || {
            c.clear();
            c.extend(ls.iter().map(|l| lines::clip(l, &w, &mut Unmetered)));
            c.len()
        },
    );
    println!("lines {:.3} {:?} {:?}", x.median, x.first, x.second);
    let ps: Vec<Vec<Point<f64, 2>>> = (0..512)
        .map(|_| {
            let n = r.usize(4..=32);
            (0..n).map(|_| pt(&mut r)).collect()
        })
        .collect();
    let s: [Vec<Vec<_>>; 2] =
        [0, 1].map(|v| ps.iter().map(|l| l.iter().map(|p| p.view(v)).collect()).collect());
    let mut o1 = [Vec::new()];
    let mut o2 = [Vec::new(), Vec::new()];
    let x = ratio(
        rounds,
        || {
            let mut n = 0;
            for s in &s {
                for p in s {
                    o1[0].clear();
                    polygons::clip(p, &w, &mut Unmetered, &mut o1);
                    n += o1[0].len();
                }
            }
            n
        },
        || {
            let mut n = 0;
            for p in &ps {
                o2[0].clear();
                o2[1].clear();
                polygons::clip(p, &w, &mut Unmetered, &mut o2);
                n += o2[0].len() + o2[1].len();
            }
            n
        },
    );
    println!("polygons {:.3} {:?} {:?}", x.median, x.first, x.second);
    let size = [256u32, 256];
    for reach in [[3.0, 3.0], [10.0, 10.0], [40.0, 40.0], [80.0, 80.0]] {
        for sides in [3usize, 4, 8, 15, 32] {
            let ps: Vec<_> = (0..200).map(|_| poly::<0>(&mut r, sides, reach)).collect();
            let s = views(&ps);
            let mut bufs = [vec![0u32; 256 * 256], vec![0u32; 256 * 256]];
            let mut bufs1 = bufs.clone();
            let (mut e1, mut e2) = (Edges::new(size, 8), Edges::new(size, 8));
            let x = ratio(
                rounds / 4,
                || {
                    for v in 0..2 {
                        for (n, p) in s[v].iter().enumerate() {
                            flat::fill(&mut e1, p, &mut Unmetered, |_, y, c| {
                                bufs1[v][y * 256..][..256][c].fill(n as u32)
                            });
                        }
                    }
                },
                || {
                    for (n, p) in ps.iter().enumerate() {
                        flat::fill(&mut e2, p, &mut Unmetered, |v, y, c| {
                            bufs[v][y * 256..][..256][c].fill(n as u32)
                        });
                    }
                },
            );
            assert!(bufs == bufs1);
            print!(
                "{reach:?} {sides} flat {:.3} {:?} {:?}  ",
                x.median,
                x.first / 200,
                x.second / 200
            );
            let ps: Vec<_> = (0..200).map(|_| poly::<3>(&mut r, sides, reach)).collect();
            let s = views(&ps);
            let mut bufs = [vec![[0u8; 3]; 256 * 256], vec![[0u8; 3]; 256 * 256]];
            let mut bufs1 = bufs.clone();
            let (mut e1, mut e2) = (Edges::new(size, 8), Edges::new(size, 8));
            let x = ratio(
                rounds / 4,
                || {
                    for v in 0..2 {
                        for p in s[v].iter() {
                            gouraud::shade(&mut e1, p, &mut Unmetered, |_, x, y, c| {
                                bufs1[v][y * 256 + x] = c.map(|n| n as u8)
                            });
                        }
                    }
                },
                || {
                    for p in ps.iter() {
                        gouraud::shade(&mut e2, p, &mut Unmetered, |v, x, y, c| {
                            bufs[v][y * 256 + x] = c.map(|n| n as u8)
                        });
                    }
                },
            );
            assert!(bufs == bufs1);
            println!("gouraud {:.3} {:?} {:?}", x.median, x.first / 200, x.second / 200);
        }
    }
}
