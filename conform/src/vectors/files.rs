//! The files of `conform/data/vectors`.

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../data/vectors/", $name, ".json")))),*]
    };
}

/// The vectors, by the name of the file that they are published in.
pub const FILES: [(&str, &str); 84] = files![
    "findings/F-01",
    "findings/F-02",
    "findings/F-03",
    "findings/F-04",
    "findings/F-05",
    "findings/F-06",
    "findings/F-07",
    "findings/F-08",
    "findings/F-09",
    "findings/F-10",
    "findings/F-11",
    "findings/F-12",
    "findings/F-13",
    "findings/F-14",
    "findings/F-15",
    "findings/F-16",
    "findings/F-17",
    "findings/F-18",
    "findings/F-20",
    "findings/F-21",
    "findings/F-22",
    "findings/F-23",
    "findings/F-24",
    "findings/F-25",
    "findings/F-26",
    "findings/F-27",
    "findings/F-28",
    "findings/F-29",
    "findings/F-30",
    "findings/F-31",
    "findings/F-32",
    "findings/F-33",
    "findings/F-34",
    "findings/F-35",
    "findings/F-36",
    "findings/F-37",
    "findings/F-38",
    "findings/F-39",
    "findings/F-40",
    "findings/F-41",
    "findings/F-42",
    "findings/F-43",
    "hardened/H-01",
    "hardened/H-02",
    "hardened/H-03",
    "hardened/H-04",
    "hardened/H-05",
    "hardened/H-06",
    "hardened/H-07",
    "hardened/H-08",
    "hardened/H-09",
    "hardened/H-10",
    "hardened/H-11",
    "hardened/H-12",
    "hardened/H-13",
    "interfaces/composition-lines",
    "interfaces/cycle-lines",
    "interfaces/offloading-lines",
    "interpretations/I-01",
    "interpretations/I-02",
    "interpretations/I-03",
    "interpretations/I-04",
    "interpretations/I-05",
    "interpretations/I-06",
    "interpretations/I-07",
    "interpretations/I-08",
    "interpretations/I-09",
    "interpretations/I-10",
    "interpretations/I-11",
    "interpretations/I-12",
    "offloading/fallback",
    "offloading/quality-of-service",
    "offloading/requester",
    "services/composition",
    "services/service",
    "stages/collision",
    "stages/detections",
    "stages/distances",
    "stages/grid",
    "stages/input",
    "stages/map-validation",
    "stages/schedule",
    "stages/track-validation",
    "stages/tracks",
];

/// The cycle of which a vector changes something: a straight road along x, 3 m to each side; the CAV
/// of 4 m by 2 m at the origin, 10 m/s; points 1 m and 0.1 s apart; a car 60 m ahead, tracked and
/// detected; a free grid of 10 m cells. Safe in every configuration of both profiles.
pub const BASE: &str = include_str!("../../data/vectors/base.json");

/// Records of which a line changes something.
pub const RECORDS: [(&str, &str); 3] =
    files!["records/cycle", "records/offloading", "records/composition"];
