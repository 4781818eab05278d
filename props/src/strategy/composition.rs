//! Service sets and compositions one change away from keeping or breaking a rule
//! (`spec/1-services.md`).

use mufasa_model::services::orchestrator::Task;
use mufasa_model::services::service::Service;

use super::draw::Draw;

const INTERFACES: [&str; 5] = ["detections", "tracks", "model", "trajectory", "map"];
const IDS: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];

/// A task over a few services; its first service is the goal.
pub fn task(draw: &mut Draw<'_>) -> Task {
    let n = draw.between(1, IDS.len());
    let services: Vec<Service> = IDS.iter().take(n).map(|id| service(draw, id)).collect();
    let goal = services[0].id.clone();
    let mut same_station = Vec::new();
    for _ in 0..draw.below(3) {
        same_station.push(some_ids(draw));
    }
    let local_only = if draw.one_in(3) { some_ids(draw) } else { Vec::new() };
    Task { services, goal, same_station, local_only }
}

/// A service list that may break a rule of service sets.
pub fn services(draw: &mut Draw<'_>) -> Vec<Service> {
    let n = draw.below(5);
    let mut list: Vec<Service> = IDS.iter().take(n).map(|id| service(draw, id)).collect();
    for _ in 0..draw.below(3) {
        disturb(draw, &mut list);
    }
    list
}

/// The list after a change that may or may not be allowed.
pub fn later(draw: &mut Draw<'_>, list: &[Service]) -> Vec<Service> {
    let mut list = list.to_vec();
    for _ in 0..draw.below(3) {
        disturb(draw, &mut list);
    }
    if draw.one_in(3) {
        list.reverse();
    }
    for service in &mut list {
        if draw.one_in(6) {
            service.requires.reverse();
        }
    }
    list
}

fn service(draw: &mut Draw<'_>, id: &str) -> Service {
    let station = draw.pick(&[0, 0, 1, 2]);
    let (requires, guarantees) = (interfaces(draw), interfaces(draw));
    Service { id: id.to_owned(), requires, guarantees, station }
}

/// Up to two different interfaces.
fn interfaces(draw: &mut Draw<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for _ in 0..draw.below(3) {
        let name = draw.pick(&INTERFACES);
        if !names.iter().any(|other| other == name) {
            names.push(name.to_owned());
        }
    }
    names
}

fn disturb(draw: &mut Draw<'_>, list: &mut Vec<Service>) {
    let index = draw.below(list.len().max(1));
    let Some(service) = list.get_mut(index) else { return };
    match draw.below(7) {
        0 => service.station = draw.pick(&[0, -1, 3, i64::MIN]),
        1 => service.requires.extend(service.requires.first().cloned()),
        2 => service.guarantees.extend(service.guarantees.first().cloned()),
        3 => service.requires.push(draw.pick(&INTERFACES).to_owned()),
        4 => {
            let again = service.clone();
            list.push(again);
        }
        5 => {
            list.remove(index);
        }
        _ => {
            let new = Service { id: "z".to_owned(), station: 0, ..service.clone() };
            list.push(new);
        }
    }
}

fn some_ids(draw: &mut Draw<'_>) -> Vec<String> {
    let n = draw.between(1, 3);
    (0..n).map(|_| draw.pick(&IDS).to_owned()).collect()
}
