//! Files that the tests read, and files that they write.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use mufasa_drives::check::checked::Checked;
use mufasa_drives::check::judge::Judged;
use mufasa_drives::{Drive, InjectError, Injection, Options, ReadError, Stream, read};
use mufasa_model::input::cycle::Track;
use mufasa_model::offloading::requester::Parameters;

/// A file of the crate's `data`.
pub fn own(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
}

/// The folder of shared recordings, `MUFASA_DATA` or `shared/data` beside the workspace; says so
/// when there is none.
pub fn shared(what: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("MUFASA_DATA").map_or(beside, PathBuf::from).join(what);
    if folder.is_dir() {
        return Some(folder);
    }
    let line = format!(
        "NOT RUN: {}: no recordings in {}; set MUFASA_DATA\n",
        std::thread::current().name().unwrap_or("a test"),
        folder.display()
    );
    // The macros' output is captured, and nobody would see it.
    std::io::stderr().write_all(line.as_bytes()).expect("standard error can be written");
    None
}

/// A folder for the files of one test, removed at its end.
pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("mufasa-readers-{}-{n}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).expect("a folder for temporary files");
        Self(folder)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, content).expect("a temporary file");
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Nothing depends on it, and a panic here would hide the test's own.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A scenario of these elements.
pub fn scenario(elements: &[String]) -> String {
    let head = "<commonRoad benchmarkID=\"ZAM_Small-1_1_T-1\" commonRoadVersion=\"2020a\" timeStepSize=\"0.1\">";
    format!("{head}{}</commonRoad>", elements.concat())
}

/// A lanelet between two bounds, with what else is in it.
pub fn lanelet(id: u32, [left, right]: [&[[f64; 2]]; 2], links: &str) -> String {
    let bound = |name: &str, points: &[[f64; 2]]| {
        let point = |[x, y]: &[f64; 2]| format!("<point><x>{x}</x><y>{y}</y></point>");
        format!("<{name}>{}</{name}>", points.iter().map(point).collect::<Vec<_>>().concat())
    };
    let bounds = bound("leftBound", left) + &bound("rightBound", right);
    format!("<lanelet id=\"{id}\">{bounds}{links}</lanelet>")
}

/// A recorded vehicle at this speed: x, y and heading at each step, from 0 on.
pub fn vehicle(
    id: u32,
    kind: &str,
    speed: f64,
    states: impl IntoIterator<Item = [f64; 3]>,
) -> String {
    let state = |(step, [x, y, heading]): (usize, [f64; 3])| {
        let name = if step == 0 { "initialState" } else { "state" };
        format!(
            "<{name}><position><point><x>{x}</x><y>{y}</y></point></position><orientation><exact>{heading}</exact>\
             </orientation><time><exact>{step}</exact></time><velocity><exact>{speed}</exact></velocity></{name}>"
        )
    };
    let states: Vec<_> = states.into_iter().enumerate().map(state).collect();
    let (first, rest) = states.split_first().expect("a first state");
    format!(
        "<dynamicObstacle id=\"{id}\"><type>{kind}</type><shape><rectangle><length>4.5</length><width>1.8</width>\
         </rectangle></shape>{first}<trajectory>{}</trajectory></dynamicObstacle>",
        rest.concat()
    )
}

/// The one drive of some files.
pub fn one(paths: &[PathBuf], options: &Options) -> Result<Drive, ReadError> {
    let mut drives = read(paths, options);
    assert_eq!(drives.len(), 1, "{drives:?}");
    drives.remove(0)
}

/// The drive of the small scenario with the solution of that name, or with a recorded vehicle.
pub fn small(version: &str, solution: Option<&str>, options: &Options) -> Drive {
    let mut paths = vec![own(&format!("readers/small-{version}.xml"))];
    paths.extend(solution.map(|s| own(&format!("readers/small.{s}.solution.xml"))));
    one(&paths, options).expect("the small scenario is read")
}

/// The drive of the demo.
pub fn demo(options: &Options) -> Drive {
    let paths = [own("demo/urban.xml"), own("demo/urban.solution.xml")];
    one(&paths, options).expect("the demo is read")
}

/// The same drive with a car, number 50, that crosses 8 m ahead of the CAV, from 10 m to its left.
pub fn crossed(mut drive: Drive) -> Drive {
    for cycle in drive.cycles.iter_mut().map(|it| &mut it.cycle) {
        let [forward, left] = [[cycle.ego.cos, cycle.ego.sin], [-cycle.ego.sin, cycle.ego.cos]];
        let at = |axis: usize, ego: f64| ego + 8.0 * forward[axis] + 10.0 * left[axis];
        let list = cycle.tracks.as_mut().expect("tracks");
        list.items.push(Track {
            id: 50,
            x: at(0, cycle.ego.x),
            y: at(1, cycle.ego.y),
            cos: -left[0],
            sin: -left[1],
            vx: -7.0 * left[0],
            vy: -7.0 * left[1],
            length: 4.5,
            width: 1.8,
        });
    }
    drive
}

/// The drive under attack, with all its cycles.
pub fn inject(drive: &Drive, injection: &Injection) -> Result<Drive, InjectError> {
    mufasa_drives::inject(&Stream::from(drive.clone()), injection).map(|it| it.collect().unwrap())
}

/// A drive, judged, with the judgement of every cycle.
pub fn judged(drive: impl Into<Stream>) -> (Checked, Vec<Judged>) {
    let mut judged = Vec::new();
    let checked = Checked::new(drive, &Parameters::default(), false, |seen| {
        judged.push(seen.judged.clone());
        Ok(())
    });
    (checked.expect("its cycles are there"), judged)
}
