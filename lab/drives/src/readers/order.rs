//! Files in the order in which they belong together: `check *.xml` names a solution before its
//! scenario.

use crate::readers::source::Source;

/// The root element of a benchmark file, with its attributes, is in its first bytes.
const HEAD: usize = 4096;

/// Which scenario a file is, or is a solution of.
enum Benchmark {
    Scenario(String),
    Solution(String),
}

/// The files with every solution moved behind the scenario of its benchmark id, where that is
/// among them and not before it already; everything else stays where it is.
pub(crate) fn solutions_behind_scenarios(mut files: Vec<Source>) -> Vec<Source> {
    if files.len() < 2 {
        return files;
    }
    let benchmarks: Vec<_> = files.iter_mut().map(|file| benchmark(&file.head(HEAD))).collect();
    let order = order(&benchmarks);
    let mut files: Vec<_> = files.into_iter().map(Some).collect();
    order.into_iter().filter_map(|index| files[index].take()).collect()
}

/// Whether a file begins as a solution does, whether or not it can be read.
pub(crate) fn is_solution(file: &mut Source) -> bool {
    matches!(benchmark(&file.head(HEAD)), Some(Benchmark::Solution(_)))
}

/// Every index once.
fn order(files: &[Option<Benchmark>]) -> Vec<usize> {
    let is_scenario = |file: &Option<Benchmark>, id: &str| matches!(file, Some(Benchmark::Scenario(scenario)) if scenario == id);
    let home = |index: usize| {
        let Some(Benchmark::Solution(id)) = &files[index] else { return None };
        let before = files[..index].iter().rev();
        let mut scenarios = before.filter(|file| matches!(file, Some(Benchmark::Scenario(_))));
        if scenarios.next().is_some_and(|scenario| is_scenario(scenario, id)) {
            return None;
        }
        files.iter().position(|file| is_scenario(file, id))
    };
    let homes: Vec<Option<usize>> = (0..files.len()).map(home).collect();
    let mut order = Vec::with_capacity(files.len());
    for index in 0..files.len() {
        if homes[index].is_none() {
            order.push(index);
        }
        order.extend((0..files.len()).filter(|moved| homes[*moved] == Some(index)));
    }
    order
}

fn benchmark(head: &[u8]) -> Option<Benchmark> {
    let head = String::from_utf8_lossy(head);
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
    use super::{benchmark, order};

    #[test]
    fn solutions_move_behind_their_scenarios_only_where_they_must() {
        let order = |names: &[&'static str]| {
            let file = |name: &&str| match name.split_at(1) {
                (id, "") => format!("<commonRoad benchmarkID=\"{id}\" x=\"1\">"),
                ("?", _) => String::from("\u{93}NUMPY"),
                (id, _) => format!("<CommonRoadSolution benchmark_id='KS2:SM1:{id}:2020a'>"),
            };
            let files: Vec<_> =
                names.iter().map(file).map(|text| benchmark(text.as_bytes())).collect();
            order(&files).into_iter().map(|index| names[index]).collect::<Vec<_>>()
        };
        assert_eq!(
            order(&["A1", "A2", "A", "?map", "B1", "B"]),
            ["A", "A1", "A2", "?map", "B", "B1"]
        );
        assert_eq!(order(&["A", "A1", "B", "B1", "A"]), ["A", "A1", "B", "B1", "A"]);
        assert_eq!(order(&["C1", "A", "C1"]), ["C1", "A", "C1"]);
    }
}
