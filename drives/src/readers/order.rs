//! Files in the order in which they belong together: `check *.xml` names a solution before its
//! scenario.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The root element of a benchmark file, with its attributes, is in its first bytes.
const HEAD: u64 = 4096;

/// Which scenario a file is, or is a solution of.
enum Benchmark {
    Scenario(String),
    Solution(String),
}

/// The paths with every solution moved behind the scenario of its benchmark id, where that is
/// among them and not before it already; everything else stays where it is.
pub(crate) fn solutions_behind_scenarios(paths: &[PathBuf]) -> Vec<PathBuf> {
    let files: Vec<_> = paths.iter().map(|path| (path, benchmark(path))).collect();
    let is_scenario = |file: &Option<Benchmark>, id: &str| matches!(file, Some(Benchmark::Scenario(scenario)) if scenario == id);
    let home = |index: usize| {
        let Some(Benchmark::Solution(id)) = &files[index].1 else { return None };
        let before = files[..index].iter().rev();
        let mut scenarios = before.filter(|(_, file)| matches!(file, Some(Benchmark::Scenario(_))));
        if scenarios.next().is_some_and(|(_, scenario)| is_scenario(scenario, id)) {
            return None;
        }
        files.iter().position(|(_, file)| is_scenario(file, id))
    };
    let homes: Vec<Option<usize>> = (0..files.len()).map(home).collect();
    let mut order = Vec::with_capacity(paths.len());
    for (index, (path, _)) in files.iter().enumerate() {
        if homes[index].is_none() {
            order.push((*path).clone());
        }
        let moved = homes.iter().zip(paths).filter(|(home, _)| **home == Some(index));
        order.extend(moved.map(|(_, solution)| solution.clone()));
    }
    order
}

fn benchmark(path: &Path) -> Option<Benchmark> {
    let mut head = Vec::new();
    File::open(path).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    let head = String::from_utf8_lossy(&head);
    if let Some(id) = attribute(&head, "benchmarkID=") {
        return Some(Benchmark::Scenario(id.to_owned()));
    }
    // Vehicle and cost function, scenario, version: KS2:SM1:DEU_Moabit-4_1_T-1:2020a.
    let id = attribute(&head, "benchmark_id=")?.split(':').nth(2)?;
    Some(Benchmark::Solution(id.to_owned()))
}

fn attribute<'a>(head: &'a str, name: &str) -> Option<&'a str> {
    let value = &head[head.find(name)? + name.len()..];
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    value[1..].split_once(quote).map(|(value, _)| value)
}

#[cfg(test)]
mod tests {
    use super::solutions_behind_scenarios;
    use std::path::PathBuf;

    #[test]
    fn solutions_move_behind_their_scenarios_only_where_they_must() {
        let folder = std::env::temp_dir().join(format!("mufasa-order-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a temporary folder");
        let file = |name: &str, text: &str| {
            let path = folder.join(name);
            std::fs::write(&path, text).expect("a temporary file");
            path
        };
        let scenario = |id: &str| {
            file(&format!("{id}.xml"), &format!("<commonRoad benchmarkID=\"{id}\" x=\"1\">"))
        };
        let solution = |id: &str, n: u8| {
            let text = format!("<CommonRoadSolution benchmark_id='KS2:SM1:{id}:2020a'>");
            file(&format!("{id}.solution{n}.xml"), &text)
        };
        let (a, b) = (scenario("A"), scenario("B"));
        let (a1, a2, b1, c1) =
            (solution("A", 1), solution("A", 2), solution("B", 1), solution("C", 1));
        let other = file("map.npy", "\u{93}NUMPY");
        let order = |paths: &[&PathBuf]| {
            solutions_behind_scenarios(&paths.iter().map(|p| (*p).clone()).collect::<Vec<_>>())
        };
        assert_eq!(
            order(&[&a1, &a2, &a, &other, &b1, &b]),
            [&a, &a1, &a2, &other, &b, &b1].map(Clone::clone)
        );
        assert_eq!(order(&[&a, &a1, &b, &b1, &a]), [&a, &a1, &b, &b1, &a].map(Clone::clone));
        assert_eq!(order(&[&c1, &a, &c1]), [&c1, &a, &c1].map(Clone::clone));
        std::fs::remove_dir_all(&folder).expect("the folder is ours");
    }
}
