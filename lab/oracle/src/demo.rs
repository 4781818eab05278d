//! The demo: a drive that is built in, clean and under the attacks of the paper (Sec. V-B), in
//! both profiles.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::Parameters;

use mufasa_drives::check::checked::Checked;
use mufasa_drives::check::fallback::Hold;
use mufasa_drives::check::findings::Findings;
use mufasa_drives::check::table;
use mufasa_drives::check::{self, pictures, report, words};
use mufasa_drives::counted;
use mufasa_drives::{self as drive, Attack, DEMO, Injection, Options, Stream};
use mufasa_records::files;
use mufasa_records::names;

use crate::ended::{DISAGREES, Ended, cannot, complain, said};

/// Where the demo puts its files unless it is told otherwise.
pub const FOLDER: &str = "mufasa-demo";

/// Start of the attacks, s since the first cycle.
const ATTACKED_FROM_S: f64 = 2.0;

/// A run over the drive.
struct Case {
    attack: Option<Attack>,
    /// What the attacker does, and what comes of it.
    story: &'static str,
    /// Whether the paper profile finds it; the hardened one finds every attack.
    paper: bool,
}

const CASES: [Case; 4] = [
    Case { attack: None, story: "nothing is injected", paper: false },
    Case {
        attack: Some(Attack::WrongMap),
        story: "the remote planner is given another map, its trajectories leave the lane",
        paper: true,
    },
    Case {
        attack: Some(Attack::EmptyTracks),
        story: "the track lists are emptied, the remote planner sees a free road",
        paper: false,
    },
    Case {
        attack: Some(Attack::GhostTracks),
        story: "tracks of objects that are not there are added to the lists",
        paper: true,
    },
];

/// Runs the demo and writes scenario, solution and a picture of every fallback into `folder`.
/// Returns the exit code: 0 when everything is as it should be, 1 when not, 2 when the folder
/// cannot be written, 3 when model and implementation disagree.
pub fn run(folder: &Path, out: &mut impl Write) -> Ended {
    let drives = prepare(folder)?;
    let mut demo = Demo {
        folder,
        findings: Findings::default(),
        surprises: Vec::new(),
        pictures: Vec::new(),
        problem: None,
    };
    introduction(&drives[0], out)?;
    let [hardened, paper] = &drives;
    writeln!(out, "HARDENED PROFILE: the published method and the rules H-nn\n")?;
    for case in &CASES {
        demo.case(case, hardened, out)?;
    }
    writeln!(out, "PAPER PROFILE: the published method, same drive, same attacks\n")?;
    let mut lines = Vec::new();
    let mut sentences = Vec::new();
    for case in &CASES {
        let checked = demo.check(case.drive(paper)?, false)?;
        lines.push(report::line(&checked.drive));
        sentences.push(format!(
            "{}: {}",
            case.name(),
            demo.outcome(case, &checked, Profile::PAPER)
        ));
    }
    write!(out, "{}", table::by_drive(&lines))?;
    for sentence in sentences {
        writeln!(out, "  {sentence}")?;
    }
    demo.finish(out)
}

/// Writes the files of the drive and reads them, in the hardened and in the paper profile.
fn prepare(folder: &Path) -> Result<[Stream; 2], String> {
    files::prepare(folder).map_err(cannot(folder, "written"))?;
    let paths = DEMO.map(|(name, _)| folder.join(name));
    for (path, (_, text)) in paths.iter().zip(DEMO) {
        files::write(path, text).map_err(cannot(path, "written"))?;
    }
    let read = |profile| {
        let options = Options { profile, ..Options::default() };
        let drives = drive::streams(&paths, &options);
        drives.into_iter().next().ok_or("no drive is built in".to_owned())
    };
    Ok([read(Profile::HARDENED)?.map_err(said)?, read(Profile::PAPER)?.map_err(said)?])
}

fn introduction(drive: &Stream, out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "A made-up drive behind another car, {} at 10 Hz. Object tracking, environment model and\n\
         planning run on a server (AllRemote). Every cycle is judged twice: by the exact model\n\
         and by the implementation.\n",
        counted(drive.count(), "cycle")
    )
}

impl Case {
    fn name(&self) -> &'static str {
        self.attack.map_or("clean", Attack::name)
    }

    fn drive(&self, clean: &Stream) -> io::Result<Stream> {
        match self.attack {
            None => Ok(clean.clone()),
            Some(attack) => {
                let injection = Injection { attack, from_s: ATTACKED_FROM_S, to_s: f64::INFINITY };
                drive::inject(clean, &injection).map_err(io::Error::other)
            }
        }
    }

    fn is_to_be_found(&self, profile: Profile) -> bool {
        self.attack.is_some() && (profile == Profile::HARDENED || self.paper)
    }
}

struct Demo<'a> {
    folder: &'a Path,
    findings: Findings,
    /// What is not as it should be.
    surprises: Vec<String>,
    /// Pictures written.
    pictures: Vec<PathBuf>,
    /// A picture that could not be written.
    problem: Option<(PathBuf, io::Error)>,
}

/// A drive, judged.
struct Driven {
    drive: Checked,
    /// Time of the first unsafe cycle, s, and why it is.
    first: Option<(f64, String)>,
}

impl Demo<'_> {
    fn case(&mut self, case: &Case, clean: &Stream, out: &mut impl Write) -> io::Result<()> {
        let checked = self.check(case.drive(clean)?, true)?;
        let [model, implementation] = &checked.drive.tallies;
        match case.attack {
            None => writeln!(out, "{}: {}", case.name(), case.story)?,
            Some(_) => {
                writeln!(out, "{}: from {ATTACKED_FROM_S} s on {}", case.name(), case.story)?;
            }
        }
        write!(out, "{}", table::by_stage(model, implementation))?;
        writeln!(out, "  {}\n", self.outcome(case, &checked, Profile::HARDENED))?;
        out.flush()
    }

    /// Judges a drive; with `draws` it draws the cycles that started a fallback.
    fn check(&mut self, drive: Stream, draws: bool) -> io::Result<Driven> {
        let progress = check::progress(drive.count());
        let (mut first, name) = (None, drive.name.clone());
        let checked = Checked::new(drive, &Parameters::default(), false, |seen| {
            progress.inc(1);
            if seen.holds[0].is_some() {
                first.get_or_insert_with(|| (seen.seconds(), words::answer(&seen.judged.model)));
            }
            if draws && matches!(seen.holds[0], Some(Hold::Started { .. })) {
                match pictures::write(self.folder, &name, seen) {
                    Ok(written) => self.pictures.extend(written),
                    Err(problem) => self.problem = Some(problem),
                }
            }
            Ok(())
        });
        progress.finish_and_clear();
        let drive = checked.map_err(io::Error::other)?;
        self.findings.add(&drive);
        self.findings.pictures = self.pictures.len();
        Ok(Driven { drive, first })
    }

    /// What became of a case in a sentence; notes what is not as it should be.
    fn outcome(&mut self, case: &Case, judged: &Driven, profile: Profile) -> String {
        let Driven { drive, first } = judged;
        let early = first.as_ref().is_some_and(|(at_s, _)| *at_s < ATTACKED_FROM_S);
        if first.is_some() != case.is_to_be_found(profile) || early {
            let profile = names::profile(profile);
            self.surprises.push(format!("{} in the {profile} profile", case.name()));
        }
        let cycles = drive.tallies[0].cycles;
        let run = drive.requesters[0];
        match (first, case.attack) {
            (None, None) => format!("all {cycles} cycles safe, no fallback"),
            (None, Some(_)) => format!(
                "NOT caught: all {cycles} cycles pass. Stage iii compares the trajectory with an \
                 empty list, which switches stages iv and v off (F-14, closed by H-14)"
            ),
            (Some((at_s, why)), _) => format!(
                "caught at {at_s:.1} s by {why}; {}, {} of {cycles} cycles unsafe",
                counted(run.fallbacks, "fallback"),
                run.unsafe_cycles
            ),
        }
    }

    fn finish(self, out: &mut impl Write) -> Ended {
        let Self { folder, findings, surprises, pictures, problem } = self;
        let folder = folder.display();
        writeln!(out)?;
        for picture in &pictures {
            writeln!(out, "picture: {}", picture.display())?;
        }
        let [scenario, solution] = DEMO.map(|(name, _)| name);
        writeln!(
            out,
            "more: mufasa check {folder}/{scenario} {folder}/{solution} --inject false-velocities@2..\n\n\
             demo: {}",
            findings.summary()
        )?;
        if let Some((file, error)) = problem {
            return Err(cannot(&file, "written")(error).into());
        }
        if findings.disagreements > 0 {
            return Ok(DISAGREES);
        }
        for surprise in &surprises {
            complain(&format!("not as expected: {surprise}"));
        }
        Ok(u8::from(!surprises.is_empty()))
    }
}
