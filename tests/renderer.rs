//! The simple renderer: both views at once against each alone, and against direct rendering.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats, FRACTION_BITS};
use wheatstone_golden::frame::NO_ID;
use wheatstone_golden::scene::{self, Cull, Scene};
use wheatstone_golden::setup::{Attributes, Eyes};
use wheatstone_golden::visibility::renderer::{Model, Views};
use wheatstone_golden::visibility::NO_ITEM;
use wheatstone_golden::work::{counted, Counted, Unmetered, Work};
use wheatstone_tests::visibility::{job, scene as geometry};

const SIZE: [u32; 2] = [640, 480];

fn village() -> Scene {
    scene::open("village", Some(SIZE), None).expect("a built-in scene")
}

fn model(scene: &Scene) -> Model {
    Model::new(scene, &Formats::new(&Config::DEFAULT)).expect("a scene for the renderer")
}

fn both(model: &Model) -> Views<2> {
    let mut views = model.views();
    model.draw::<f64, 2>(Eye::BOTH, &mut views, &mut Unmetered);
    views
}

#[test]
fn both_views_at_once_are_each_alone_bit_for_bit() {
    let model = model(&village());
    let together = both(&model);
    for eye in Eye::BOTH {
        let mut alone = model.views();
        model.draw::<f64, 1>([eye], &mut alone, &mut Unmetered);
        assert!(alone.items[0] == together.items[eye as usize], "items of the {} eye", eye.name());
        assert!(alone.colours[0] == together.colours[eye as usize], "colours of {}", eye.name());
    }
}

/// The same triangles at every pixel, and colours that differ by rounding only. (A triangle that
/// one eye alone sees may be lit from its other side in direct rendering.)
#[test]
fn the_village_is_as_direct_rendering_draws_it() {
    let model = model(&village());
    assert!((1_050..1_150).contains(&model.triangles()), "{}", model.triangles());
    let views = both(&model);
    let seen = geometry("village", SIZE, Cull::Back);
    let (job, formats) = (job(&seen.polygons, SIZE), Formats::new(&Config::DEFAULT));
    let one_eyed: Vec<u32> =
        seen.polygons.iter().filter(|p| p.eyes != Eyes::Both).map(|p| p.id).collect();
    for (view, direct) in job.direct().iter().enumerate() {
        let picture = views.picture(view);
        let (mut ties, mut levels) = (0, 0);
        for (n, (&item, &id)) in views.items[view].item.iter().zip(&direct.id).enumerate() {
            let [x, y] = [n as u32 % SIZE[0], n as u32 / SIZE[0]];
            if item != id {
                let depth = |id: u32| {
                    let polygon = seen.polygons.iter().find(|p| p.id == id).expect("it is seen");
                    let depth = Attributes::depth(polygon, Eye::BOTH[view], &formats);
                    depth.at(x.into(), y.into()) >> FRACTION_BITS
                };
                assert!(depth(item).abs_diff(depth(id)) <= 1, "{x}, {y}: {item}, {id}");
                ties += 1;
                continue;
            }
            let found = picture.get_pixel(x, y).0;
            if item == NO_ITEM {
                assert_eq!((id, found), (NO_ID, seen.background.rgb()));
            } else if !one_eyed.contains(&id) {
                let worst = (0..3).map(|k| found[k].abs_diff(direct.colour[n][k])).max();
                assert!(worst <= Some(1), "{x}, {y}: {found:?}, {:?}", direct.colour[n]);
                levels += u32::from(worst == Some(1));
            }
        }
        println!("view {view}: {ties} ties, {levels} colours a level away");
        assert!(ties <= 20, "{ties} pixels show another triangle");
        assert!(levels < SIZE[0] * SIZE[1] / 50, "{levels} colours are a level away");
    }
}

#[test]
fn together_is_less_work() {
    let model = model(&village());
    let mut twice = Work::default();
    let ((), operations) = counted(|| {
        for eye in Eye::BOTH {
            model.draw::<Counted, 1>([eye], &mut model.views(), &mut twice);
        }
    });
    twice.operations = operations;
    let mut both = Work::default();
    let ((), operations) =
        counted(|| model.draw::<Counted, 2>(Eye::BOTH, &mut model.views(), &mut both));
    both.operations = operations;
    println!("twice {twice:?}\nboth {both:?}");
    assert_eq!(both.pixels_written, twice.pixels_written);
    assert!((both.operations.all() as f64) < 0.75 * twice.operations.all() as f64);
    assert!((both.edge_updates as f64) < 0.52 * twice.edge_updates as f64);
    assert!(both.interpolations < twice.interpolations);
}

#[test]
fn scenes_that_are_not_for_it_are_refused() {
    let refused = |name: &str, change: fn(&mut Scene), text: &str| {
        let mut scene = scene::open(name, Some(SIZE), None).expect("a built-in scene");
        change(&mut scene);
        let error = Model::new(&scene, &Formats::new(&Config::DEFAULT)).unwrap_err().to_string();
        assert!(error.contains(text), "{name}: {error}");
    };
    refused("teapot", |_| (), "mesh 0: expected triangles of a dull");
    refused("ramp", |_| (), "no light");
    refused("village", |scene| scene.rig.head_tilt = 3.0, "head_tilt: expected 0, found 3");
    refused("village", |scene| scene.rig.pixels_per_unit *= 9.0, "guard band");
    refused("village", |scene| scene.materials[0].alpha = 0.5, "opaque");
}
