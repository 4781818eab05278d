//! `CommonRoad` scenarios, versions 2018b and 2020a: lanelets and obstacles over time.
//!
//! Interval values (`intervalStart`, positions given as a shape) are taken at their middle, and
//! counted in a note: the middle is what a tracker would report of an uncertain measurement.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::counted;
use crate::geometry::{Point, Rectangle, add};
use crate::readers::error::{ReadError, quoted};
use crate::readers::lanes::{Lanelet, Network};
use crate::readers::left_out::{self, LeftOut};
use crate::readers::sides;
use crate::readers::xml::{Document, Element};
use crate::recording::object::{Footprint, Motion, Object, State};

/// A scenario as far as drives need it.
pub(crate) struct Scenario {
    /// `benchmarkID`.
    pub name: String,
    /// `commonRoadVersion`.
    pub version: String,
    /// Duration of a time step, ns.
    pub dt_ns: i64,
    pub network: Network,
    pub left_out: Vec<LeftOut>,
    /// In the order of the file.
    pub objects: Vec<Object>,
    pub notes: Vec<String>,
}

/// Reads a scenario from the text of a file.
pub(crate) fn read(file: &Path, text: &str) -> Result<Scenario, ReadError> {
    let mut document = Document::of(file, text)?;
    let root = document.root();
    let version = root.attribute("commonRoadVersion")?.to_owned();
    if !matches!(version.as_str(), "2018b" | "2020a") {
        let message = format!(
            "version {} is not read; 2018b and 2020a are: write it as one of them",
            quoted(&version)
        );
        return Err(root.error("commonRoadVersion", message));
    }
    let (name, dt_ns) = (root.attribute("benchmarkID")?.to_owned(), time_step(root)?);
    let mut reader = Reader::default();
    document.each_child(|child| reader.child(child))?;
    let Reader { lanelets, left_out, objects, .. } = &reader;
    // Where there is no other, the file has its bounds the wrong way round.
    if let (true, Some(first)) = (lanelets.is_empty(), left_out.first()) {
        return Err(first.error.clone());
    }
    distinct_ids(document.root(), objects)?;
    let notes = left_out::note(left_out).into_iter().chain(reader.dangling()).chain(reader.notes());
    let notes = notes.collect();
    let Reader { lanelets, left_out, objects, .. } = reader;
    Ok(Scenario { name, version, dt_ns, network: Network { lanelets }, left_out, objects, notes })
}

fn time_step(root: Element<'_>) -> Result<i64, ReadError> {
    let text = root.attribute("timeStepSize")?;
    let seconds: f64 = text.trim().parse().unwrap_or(f64::NAN);
    if !(0.001..=10.0).contains(&seconds) {
        let message = format!("{} is no time step between 0.001 and 10 s", quoted(text));
        return Err(root.error("timeStepSize", message));
    }
    #[expect(clippy::cast_possible_truncation, reason = "within 1e6 and 1e10")]
    Ok((seconds * 1e9).round() as i64)
}

fn distinct_ids(root: Element<'_>, objects: &[Object]) -> Result<(), ReadError> {
    let mut seen = BTreeSet::new();
    match objects.iter().find(|o| !seen.insert(o.id)) {
        Some(o) => Err(root.error("id", format!("two obstacles have the id {}", o.id))),
        None => Ok(()),
    }
}

fn lanelet(element: Element<'_>, id: i64) -> Result<Lanelet, ReadError> {
    let left = element.get("leftBound")?.points()?;
    let right = element.get("rightBound")?.points()?;
    if left.len() != right.len() || left.len() < 2 {
        let message = format!(
            "{} left and {} right points; corresponding points, two at least, are needed",
            left.len(),
            right.len()
        );
        return Err(element.error("leftBound", message));
    }
    let references = |name: &'static str| -> Result<Vec<i64>, ReadError> {
        let ids: Result<Vec<_>, _> =
            element.all(name).map(|e| e.integer_attribute("ref")).collect();
        // A network has many, and what is collected has room for more than it holds.
        ids.map(|mut ids| {
            ids.shrink_to_fit();
            ids
        })
    };
    let beside = |name: &'static str| -> Result<Option<i64>, ReadError> {
        match element.find(name) {
            Some(e) if e.attribute("drivingDir")? == "same" => e.integer_attribute("ref").map(Some),
            _ => Ok(None),
        }
    };
    Ok(Lanelet {
        successors: references("successor")?,
        predecessors: references("predecessor")?,
        beside: [beside("adjacentLeft")?, beside("adjacentRight")?],
        ..Lanelet::between(id, left, right)
    })
}

/// What was met on the way.
#[derive(Default)]
struct Reader {
    lanelets: BTreeMap<i64, Box<Lanelet>>,
    /// Lanelets whose bounds are on the wrong sides.
    left_out: Vec<LeftOut>,
    ids_left_out: BTreeSet<i64>,
    objects: Vec<Object>,
    intervals: usize,
    sets: usize,
    slivers: usize,
    obstacles_left_out: usize,
}

impl Reader {
    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.intervals > 0 {
            notes.push(format!(
                "{} with intervals or areas; the middle of each is taken",
                counted(self.intervals, "state")
            ));
        }
        if self.sets > 0 {
            notes.push(format!(
                "{} given as sets of occupied places: from the second step on, each place is an \
                 object that stands still, with the smallest rectangle around it",
                counted(self.sets, "obstacle")
            ));
        }
        if self.slivers > 0 {
            notes.push(format!(
                "{} widened to 0.01 m",
                counted(self.slivers, "place that is occupied")
            ));
        }
        if self.obstacles_left_out > 0 {
            let count = counted(self.obstacles_left_out, "obstacle");
            notes.push(format!("{count} left out, of environment or phantoms"));
        }
        notes
    }

    /// What is said of successors that are no other lanelet of the file; `None` where there are none.
    fn dangling(&self) -> Option<String> {
        let is_other = |from: i64, to: i64| {
            from != to && (self.lanelets.contains_key(&to) || self.ids_left_out.contains(&to))
        };
        let all = self.lanelets.values().map(AsRef::as_ref);
        let links = all.flat_map(|it: &Lanelet| it.successors.iter().map(|to| (it.id, *to)));
        let wrong: Vec<_> = links.filter(|(from, to)| !is_other(*from, *to)).collect();
        let (first, _) = wrong.split_at(wrong.len().min(left_out::NAMED_MAX));
        let names: Vec<_> = first.iter().map(|(from, to)| format!("{from} -> {to}")).collect();
        let more = if wrong.len() > names.len() { ", ..." } else { "" };
        let count = counted(wrong.len(), "successor");
        let names = names.join(", ");
        (!wrong.is_empty()).then(|| {
            format!("{count} of lanelets not in this file, or the lanelet itself: {names}{more}")
        })
    }

    /// Takes a child of the root.
    fn child(&mut self, element: Element<'_>) -> Result<(), ReadError> {
        let role = match element.name() {
            "lanelet" => return self.lanelet(element),
            "obstacle" => element.get("role")?.text(),
            "dynamicObstacle" => "dynamic",
            "staticObstacle" => "static",
            "environmentObstacle" | "phantomObstacle" => {
                self.obstacles_left_out += 1;
                return Ok(());
            }
            _ => return Ok(()),
        };
        let object = self.object(element, role)?;
        self.objects.push(object);
        Ok(())
    }

    fn lanelet(&mut self, element: Element<'_>) -> Result<(), ReadError> {
        let id = element.integer_attribute("id")?;
        if self.lanelets.contains_key(&id) || self.ids_left_out.contains(&id) {
            return Err(element.error("id", "two lanelets have this id"));
        }
        let lanelet = lanelet(element, id)?;
        if let Some(inversion) = sides::inversion(&lanelet) {
            self.ids_left_out.insert(id);
            self.left_out.push(LeftOut::of(lanelet, inversion, element));
        } else {
            self.lanelets.insert(id, Box::new(lanelet));
        }
        Ok(())
    }

    fn object(&mut self, element: Element<'_>, role: &str) -> Result<Object, ReadError> {
        let id = element.integer_attribute("id")?;
        let footprint = footprint(element.get("shape")?)?;
        let is_static = match role {
            "static" => true,
            "dynamic" => false,
            other => {
                return Err(element.error(
                    "role",
                    format!("{} is no role; `static` and `dynamic` are", quoted(other)),
                ));
            }
        };
        let initial = self.state(element.get("initialState")?, is_static)?;
        let motion = if is_static {
            Motion::Standing(initial)
        } else if let Some(trajectory) = element.find("trajectory") {
            Motion::Moving(self.states(initial, trajectory)?)
        } else if let Some(set) = element.find("occupancySet") {
            self.sets += 1;
            Motion::Occupied { initial, places: self.occupancies(set)? }
        } else {
            Motion::Moving(vec![initial])
        };
        let kind = element.find("type").map_or("", Element::text).to_owned();
        Ok(Object { id, kind, footprint, motion })
    }

    /// The initial state and those of the trajectory; some files repeat the initial one there.
    fn states(&mut self, initial: State, trajectory: Element<'_>) -> Result<Vec<State>, ReadError> {
        let mut states = vec![initial];
        for (i, element) in trajectory.all("state").enumerate() {
            let state = self.state(element, false).map_err(|e| e.index(i))?;
            if i == 0 && state == initial {
                continue;
            }
            if states.last().is_some_and(|last| state.step <= last.step) {
                return Err(element.error("time", "time does not increase").index(i));
            }
            states.push(state);
        }
        Ok(states)
    }

    fn state(&mut self, element: Element<'_>, is_static: bool) -> Result<State, ReadError> {
        let before = self.intervals;
        let time = element.get("time")?;
        let step = time
            .find("exact")
            .ok_or_else(|| time.error("exact", "a state at an interval of times has no cycle"))?
            .step()?;
        let position = self.position(element.get("position")?)?;
        let heading = self.value(element.get("orientation")?)?;
        let speed = match element.find("velocity") {
            Some(e) => element.velocity(self.value(e)?)?,
            None if is_static => 0.0,
            None => return Err(element.error("velocity", "this element is missing")),
        };
        let slip = element.find("slipAngle").map_or(Ok(0.0), |e| self.value(e))?;
        // A state counts once, however many of its values are intervals.
        self.intervals = self.intervals.min(before + 1);
        Ok(State { step, position, heading, speed, slip })
    }

    /// The occupied places of a set-based prediction, step by step. Slivers are widened to the
    /// least width in the domain.
    fn occupancies(
        &mut self,
        set: Element<'_>,
    ) -> Result<BTreeMap<i64, Vec<Rectangle>>, ReadError> {
        let mut places: BTreeMap<i64, Vec<Rectangle>> = BTreeMap::new();
        for (i, occupancy) in set.all("occupancy").enumerate() {
            let time = occupancy.get("time")?;
            let (first, last) = match time.find("exact") {
                Some(exact) => (exact.step()?, exact.step()?),
                None => (time.get("intervalStart")?.step()?, time.get("intervalEnd")?.step()?),
            };
            if last - first > 10_000 {
                return Err(occupancy.error("time", "longer than 10000 steps").index(i));
            }
            for shape in occupancy.get("shape")?.children() {
                let mut rectangle = match outline(shape)? {
                    (_, Some(f)) => f.at([0.0, 0.0], 0.0),
                    (points, None) => Rectangle::smallest_around(&points)
                        .ok_or_else(|| shape.error("point", "no extent").index(i))?,
                };
                if rectangle.length > 100.0 || rectangle.width > 100.0 {
                    return Err(shape.error("point", "larger than 100 m").index(i));
                }
                if rectangle.length < 0.01 || rectangle.width < 0.01 {
                    self.slivers += 1;
                    rectangle.length = rectangle.length.max(0.01);
                    rectangle.width = rectangle.width.max(0.01);
                }
                for step in first..=last {
                    places.entry(step).or_default().push(rectangle);
                }
            }
        }
        Ok(places)
    }

    /// A value that is exact, or the middle of an interval.
    fn value(&mut self, element: Element<'_>) -> Result<f64, ReadError> {
        if let Some(exact) = element.find("exact") {
            return exact.number();
        }
        if element.find("intervalStart").is_none() {
            return Err(element.error("exact", "neither `exact` nor `intervalStart` is given"));
        }
        let low = element.get("intervalStart")?.number()?;
        let high = element.get("intervalEnd")?.number()?;
        self.intervals += 1;
        Ok(low + (high - low) / 2.0)
    }

    fn position(&mut self, element: Element<'_>) -> Result<Point, ReadError> {
        if let Some(point) = element.find("point") {
            return point.point();
        }
        for name in ["rectangle", "circle"] {
            if let Some(shape) = element.find(name) {
                self.intervals += 1;
                return shape.get("center")?.point();
            }
        }
        Err(element.error("point", "a position as polygon or lanelet is not read"))
    }
}

/// Shapes of an obstacle in its own frame, as one rectangle: a circle as the square around it,
/// everything else that is not one rectangle as the bounding rectangle along the frame.
fn footprint(element: Element<'_>) -> Result<Footprint, ReadError> {
    let shapes: Vec<Element<'_>> = element.children().collect();
    let mut points = Vec::new();
    for shape in &shapes {
        let (corners, alone) = outline(*shape)?;
        if let (Some(alone), 1) = (alone, shapes.len()) {
            return Ok(alone);
        }
        points.extend(corners);
    }
    if points.len() < 3 {
        return Err(element.error("", "a rectangle, circle or polygon is needed"));
    }
    let around = Rectangle::around(&points, 0.0);
    let message = "the bounding rectangle is not within 0.01 and 100 m";
    for size in [around.length, around.width] {
        if !(0.01..=100.0).contains(&size) {
            return Err(element.error("", message));
        }
    }
    Ok(Footprint { length: around.length, width: around.width, center: around.center, turn: 0.0 })
}

/// Points around a shape, and the shape itself when it is a rectangle.
fn outline(shape: Element<'_>) -> Result<(Vec<Point>, Option<Footprint>), ReadError> {
    let center = shape.find("center").map_or(Ok([0.0, 0.0]), Element::point)?;
    match shape.name() {
        "rectangle" => {
            let length = shape.number_in("length", 0.01, 100.0)?;
            let width = shape.number_in("width", 0.01, 100.0)?;
            let turn = shape.find("orientation").map_or(Ok(0.0), Element::number)?;
            let corners = Rectangle { center, heading: turn, length, width }.corners();
            Ok((corners.to_vec(), Some(Footprint { length, width, center, turn })))
        }
        "circle" => {
            let radius = shape.number_in("radius", 0.005, 50.0)?;
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let corners = corners.map(|[x, y]| add(center, [x * radius, y * radius]));
            Ok((corners.to_vec(), None))
        }
        "polygon" => Ok((shape.points()?, None)),
        other => Err(shape.error(
            "",
            format!("shape {} is not read; rectangle, circle and polygon are", quoted(other)),
        )),
    }
}
