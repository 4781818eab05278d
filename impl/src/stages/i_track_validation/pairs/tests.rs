use super::*;

#[test]
fn what_is_no_assignment_is_seen() {
    let track = Track {
        id: 0,
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        vx: 0.0,
        vy: 0.0,
        length: 1.0,
        width: 1.0,
    };
    let detection = Detection { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, length: 1.0, width: 1.0 };
    let (tracks, detections) = ([track; 2], [detection; 2]);
    // The columns of the rows, the rows of the columns; the third column is spare.
    let are_pairs = |of_rows: [u16; 2], of_columns: [u16; 3], k: usize| {
        let rows = [0_u16, 1].map(|it| Row {
            track: it,
            column: of_rows[usize::from(it)],
            ..Row::default()
        });
        let mut columns = [Column::default(); 3];
        let places = Places::standing(&tracks);
        let pairs =
            Pairs::new((places, &detections), false, 4_294_967_296.0, (&rows, &mut columns));
        for (column, row) in columns.iter_mut().zip(of_columns) {
            column.row = row;
        }
        pairs.are_one_to_one(&rows, &columns, k)
    };
    assert!(are_pairs([0, 1], [0, 1, NONE], 2));
    assert!(are_pairs([1, 0], [1, 0, NONE], 2));
    assert!(are_pairs([0, 2], [0, NONE, 1], 1), "one of two is missed");
    assert!(!are_pairs([0, 2], [0, NONE, 1], 2), "a spare column is no pair");
    assert!(!are_pairs([0, NONE], [0, NONE, NONE], 2), "too few");
    assert!(!are_pairs([0, 1], [0, 0, NONE], 2), "a row twice");
    assert!(!are_pairs([1, 1], [0, 1, NONE], 2), "a column twice");
}
