//! Message sequence charts, as SVG: who sends what to whom, and in which state each is.

use super::canvas::Canvas;

/// What happens between some partners, row by row from above.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chart {
    /// First line.
    pub title: String,
    /// Second line; may be empty.
    pub subtitle: String,
    /// The partners from left to right.
    pub partners: Vec<Partner>,
    /// Number of rows.
    pub rows: usize,
    /// Messages.
    pub arrows: Vec<Arrow>,
    /// Words beside a partner.
    pub notes: Vec<Note>,
    /// States of partners.
    pub spans: Vec<Span>,
    /// Rows before which time passes, with its words.
    pub times: Vec<(usize, String)>,
}

/// A partner with its bars of states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Partner {
    /// Its name.
    pub name: String,
    /// Names of its bars, from left to right; may be none.
    pub bars: Vec<&'static str>,
}

/// A message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// Partner and row of the sender.
    pub from: (usize, usize),
    /// Partner and row of the receiver.
    pub to: (usize, usize),
    /// Its words.
    pub text: String,
    /// What becomes of it.
    pub fate: Fate,
}

/// What becomes of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It arrives.
    Arrives,
    /// It arrives, but its sender was not allowed to send it.
    Forged,
    /// It does not arrive, or not any more in the chart.
    Lost,
}

/// Words beside a partner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Beside which partner.
    pub partner: usize,
    /// In which row.
    pub row: usize,
    /// What.
    pub text: String,
}

/// A state of a partner, from the end of one row to the end of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Which partner.
    pub partner: usize,
    /// Which of its bars.
    pub bar: usize,
    /// First row.
    pub from: usize,
    /// Last row.
    pub to: usize,
    /// In which state.
    pub state: State,
}

/// States of a group of services.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The local services compute, and no server is asked.
    Local,
    /// The local services compute, a station is asked.
    Requested,
    /// A station runs it, the local services compute too.
    Both,
    /// A station runs it and has delivered a result that was used.
    Remote,
    /// A station runs it, no result of it was used, the local services do not compute.
    Gap,
}

impl State {
    const ALL: [Self; 5] = [Self::Local, Self::Requested, Self::Both, Self::Remote, Self::Gap];

    const fn class(self) -> &'static str {
        match self {
            Self::Local => "local",
            Self::Requested => "requested",
            Self::Both => "both",
            Self::Remote => "remote",
            Self::Gap => "gap",
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Local => "local",
            Self::Requested => "requested, local services compute",
            Self::Both => "remote, local services compute too",
            Self::Remote => "remote",
            Self::Gap => "no result from anywhere",
        }
    }
}

const STYLE: &str = "\
text{font-family:'DejaVu Sans',Verdana,Helvetica,sans-serif;fill:#1d2733;font-size:13px}\
.title{font-size:19px;font-weight:bold}.subtitle{font-size:14px;fill:#4b5866}\
.name{font-weight:bold;text-anchor:middle}.bar-name{font-size:11px;text-anchor:middle}\
.on{text-anchor:middle;stroke:#fff;stroke-width:4;paint-order:stroke}\
.note{font-style:italic}.time{font-size:12px;fill:#6a7683}\
.head{fill:#e9eef3;stroke:#6a7683}.line{stroke:#6a7683;stroke-width:1.2;fill:none}\
.tick{stroke:#b8c2cc;stroke-width:1;stroke-dasharray:3 4;fill:none}\
.arrow{stroke:#1d2733;stroke-width:1.5;fill:none}.tip{fill:#1d2733}\
.forged{stroke:#b3001f;stroke-width:1.5;stroke-dasharray:6 3;fill:none}.forged-tip{fill:#b3001f}\
.lost{stroke:#8694a3;stroke-width:1.5;fill:none}.cross{stroke:#b3001f;stroke-width:2;fill:none}\
.local{fill:#7bc29a}.requested{fill:#f2cc60}.both{fill:#8fd0d8}.remote{fill:#7c9fd3}\
.gap{fill:#e4002b}.local,.requested,.both,.remote,.gap{stroke:#fff;stroke-width:1}";

const LEFT: f64 = 110.0;
const TOP: f64 = 118.0;
const ROW: f64 = 36.0;
const SPACING: f64 = 300.0;
const BAR: f64 = 14.0;
const HEAD: [f64; 2] = [150.0, 28.0];
const LEGEND: f64 = 46.0;

/// The chart as an SVG document.
pub fn draw(chart: &Chart) -> String {
    let page = Page { chart };
    let mut canvas = Canvas::default();
    canvas.text(Some([20.0, 28.0]), "title", &chart.title);
    canvas.text(Some([20.0, 50.0]), "subtitle", &chart.subtitle);
    page.heads(&mut canvas);
    for (row, words) in &chart.times {
        let y = y(*row) - ROW / 2.0;
        canvas.polyline(&[Some([20.0, y]), Some([page.width() - 20.0, y])], "tick");
        canvas.text(Some([20.0, y - 4.0]), "time", words);
    }
    for span in &chart.spans {
        page.span(&mut canvas, span);
    }
    for arrow in &chart.arrows {
        page.arrow(&mut canvas, arrow);
    }
    for note in &chart.notes {
        let x = page.right_of(note.partner) + 8.0;
        canvas.text(Some([x, y(note.row) + 15.0]), "note", &note.text);
    }
    page.legend(&mut canvas);
    canvas.document([page.width(), page.height()], &chart.title, STYLE)
}

struct Page<'a> {
    chart: &'a Chart,
}

impl Page<'_> {
    fn width(&self) -> f64 {
        let gaps = self.chart.partners.len().saturating_sub(1);
        let [title, subtitle] =
            [&self.chart.title, &self.chart.subtitle].map(|it| count(it.chars().count()));
        let partners = LEFT + SPACING * count(gaps) + 260.0;
        // Mean widths of a letter in the two sizes.
        [700.0, 40.0 + 12.0 * title, 40.0 + 8.4 * subtitle].into_iter().fold(partners, f64::max)
    }

    fn height(&self) -> f64 {
        TOP + ROW * (count(self.chart.rows) + 0.5) + LEGEND
    }

    /// Half the width of a partner's bars.
    fn half(&self, partner: usize) -> f64 {
        let bars = self.chart.partners.get(partner).map_or(0, |it| it.bars.len());
        count(bars) * BAR / 2.0
    }

    fn right_of(&self, partner: usize) -> f64 {
        x(partner) + self.half(partner)
    }

    fn heads(&self, canvas: &mut Canvas) {
        let bottom = TOP + ROW * (count(self.chart.rows) + 0.4);
        for (place, partner) in self.chart.partners.iter().enumerate() {
            let middle = x(place);
            canvas.polyline(&[Some([middle, TOP]), Some([middle, bottom])], "line");
            canvas.rect([middle - HEAD[0] / 2.0, 66.0], HEAD, "head");
            canvas.text(Some([middle, 85.0]), "name", &partner.name);
            for (bar, name) in partner.bars.iter().enumerate() {
                let x = middle - self.half(place) + BAR * (count(bar) + 0.5);
                // Two names do not fit beside each other above their bars.
                let shift = match (partner.bars.len(), bar % 2) {
                    (1, _) => 0.0,
                    (_, 0) => -14.0,
                    _ => 16.0,
                };
                canvas.text(Some([x + shift, TOP - 6.0]), "bar-name", name);
            }
        }
    }

    fn span(&self, canvas: &mut Canvas, span: &Span) {
        let left = x(span.partner) - self.half(span.partner) + BAR * count(span.bar);
        let (top, bottom) = (y(span.from), y(span.to + 1));
        canvas.rect([left, top], [BAR, bottom - top], span.state.class());
    }

    fn arrow(&self, canvas: &mut Canvas, arrow: &Arrow) {
        let [from, to] = [arrow.from.0, arrow.to.0];
        let side = if to > from { 1.0 } else { -1.0 };
        let start = [x(from) + side * self.half(from), y(arrow.from.1)];
        let end = [x(to) - side * self.half(to), y(arrow.to.1)];
        let middle = [f64::midpoint(start[0], end[0]), f64::midpoint(start[1], end[1])];
        let (line, end) = match arrow.fate {
            Fate::Arrives => ("arrow", end),
            Fate::Forged => ("forged", end),
            Fate::Lost => ("lost", [end[0] - side * 60.0, end[1]]),
        };
        canvas.polyline(&[Some(start), Some(end)], line);
        match arrow.fate {
            Fate::Arrives => canvas.tip(start, end, 9.0, "tip"),
            Fate::Forged => canvas.tip(start, end, 9.0, "forged-tip"),
            Fate::Lost => canvas.cross(end, 5.0, "cross"),
        }
        canvas.text(Some([middle[0], middle[1] - 6.0]), "on", &arrow.text);
    }

    fn legend(&self, canvas: &mut Canvas) {
        let y = self.height() - 18.0;
        let mut x = 20.0;
        for state in State::ALL {
            if self.chart.spans.iter().any(|span| span.state == state) {
                canvas.rect([x, y - 12.0], [BAR, BAR], state.class());
                canvas.text(Some([x + BAR + 6.0, y]), "time", state.words());
                x += 40.0 + 7.2 * count(state.words().len());
            }
        }
    }
}

fn x(partner: usize) -> f64 {
    LEFT + SPACING * count(partner)
}

fn y(row: usize) -> f64 {
    TOP + ROW * (count(row) + 0.7)
}

/// A small count as a coordinate.
#[expect(clippy::cast_precision_loss, reason = "rows and partners are few")]
fn count(number: usize) -> f64 {
    number as f64
}

#[cfg(test)]
mod tests {
    use super::{Arrow, Chart, Fate, Note, Partner, Span, State, draw};

    fn chart() -> Chart {
        let partner = |name: &str, bars| Partner { name: name.to_owned(), bars };
        let arrow = |from, to, fate| Arrow { from, to, text: String::from("a < b"), fate };
        Chart {
            title: String::from("t & u"),
            subtitle: String::new(),
            partners: vec![partner("CAV", vec!["MOT", "PLAN"]), partner("station 1", vec![])],
            rows: 3,
            arrows: vec![
                arrow((0, 0), (1, 1), Fate::Arrives),
                arrow((1, 1), (0, 2), Fate::Forged),
                arrow((0, 2), (1, 2), Fate::Lost),
            ],
            notes: vec![Note { partner: 0, row: 1, text: String::from("tick") }],
            spans: vec![Span { partner: 0, bar: 1, from: 0, to: 2, state: State::Gap }],
            times: vec![(1, String::from("1 ns"))],
        }
    }

    #[test]
    fn every_part_of_a_chart_is_drawn() {
        let svg = draw(&chart());
        for part in ["t &amp; u", "a &lt; b", ">tick<", "class=\"gap\"", "class=\"cross\"", "1 ns"]
        {
            assert!(svg.contains(part), "{part} is missing");
        }
        assert_eq!(svg.matches("class=\"tip\"").count(), 1);
        assert_eq!(svg.matches("class=\"forged-tip\"").count(), 1);
        assert!(svg.contains(State::Gap.words()) && !svg.contains(State::Requested.words()));
        assert!(roxmltree::Document::parse(&svg).is_ok(), "not XML");
    }

    #[test]
    fn a_chart_grows_with_its_rows() {
        let height = |chart: &Chart| super::Page { chart }.height();
        let mut longer = chart();
        longer.rows += 1;
        assert!(height(&longer) > height(&chart()));
    }
}
