//! Where the boxes and arrows of a graph go: layers by the longest path from the goal, order by
//! barycentres, places by least squares. An arrow over several layers gets a lane of its own
//! through each, so that no arrow crosses a box.

use super::graph::Graph;

/// Least room between neighbours of a layer, px.
const GAP: f64 = 22.0;
/// Room for an arrow that passes through a layer, px.
const LANE: f64 = 10.0;
/// Sweeps over all layers for the order, and for the places, which converge slowly.
const ORDER_SWEEPS: usize = 24;
const PLACE_SWEEPS: usize = 120;

/// Places in px; x grows to the right from 0.
pub struct Layout {
    /// Layer of every node; the goal is in layer 0.
    pub layer: Vec<usize>,
    /// Centre of every node.
    pub x: Vec<f64>,
    /// Lanes of every edge in the layers between consumer and provider, from the consumer on.
    pub lanes: Vec<Vec<f64>>,
    /// Width of everything.
    pub width: f64,
    /// Number of layers.
    pub layers: usize,
}

/// Lays out the graph; `widths` are those of the boxes.
pub fn lay_out(graph: &Graph, widths: &[f64]) -> Layout {
    let layer = layers(graph);
    let mut sheet = Sheet::new(graph, &layer, widths);
    sheet.sort();
    sheet.place();
    let left = sheet.edge_of_all(|item, x| x - item / 2.0, f64::min);
    let right = sheet.edge_of_all(|item, x| x + item / 2.0, f64::max);
    let x: Vec<f64> = sheet.x.iter().map(|x| x - left).collect();
    let nodes = graph.nodes.len();
    Layout {
        x: x[..nodes].to_vec(),
        lanes: sheet
            .chains
            .iter()
            .map(|chain| chain.iter().filter(|item| **item >= nodes).map(|item| x[*item]).collect())
            .collect(),
        width: right - left,
        layers: sheet.layers.len(),
        layer,
    }
}

/// The longest path from the goal to each node. Links that close a cycle count for nothing.
fn layers(graph: &Graph) -> Vec<usize> {
    let mut providers = vec![Vec::new(); graph.nodes.len()];
    for edge in &graph.edges {
        providers[edge.consumer].push(edge.provider);
    }
    let mut state = vec![Visit::New; graph.nodes.len()];
    let mut kept = vec![Vec::new(); graph.nodes.len()];
    let mut finished = Vec::new();
    let mut path = vec![(0, 0)];
    state[0] = Visit::OnPath;
    while let Some((node, next)) = path.last_mut() {
        let here = *node;
        let Some(&provider) = providers[here].get(*next) else {
            state[here] = Visit::Done;
            finished.push(here);
            path.pop();
            continue;
        };
        *next += 1;
        if state[provider] != Visit::OnPath {
            kept[here].push(provider);
        }
        if state[provider] == Visit::New {
            state[provider] = Visit::OnPath;
            path.push((provider, 0));
        }
    }
    let mut layer = vec![0; graph.nodes.len()];
    for consumer in finished.into_iter().rev() {
        for &provider in &kept[consumer] {
            layer[provider] = layer[provider].max(layer[consumer] + 1);
        }
    }
    layer
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Visit {
    New,
    OnPath,
    Done,
}

/// Items are the nodes, then one lane per edge and layer that the edge passes through.
struct Sheet {
    layers: Vec<Vec<usize>>,
    widths: Vec<f64>,
    x: Vec<f64>,
    /// Items of every edge from consumer to provider; empty for an edge that goes upwards.
    chains: Vec<Vec<usize>>,
    /// Neighbours of every item in the layer above and below.
    above: Vec<Vec<usize>>,
    below: Vec<Vec<usize>>,
}

impl Sheet {
    fn new(graph: &Graph, layer: &[usize], widths: &[f64]) -> Self {
        let count = layer.iter().max().map_or(0, |last| last + 1);
        let mut layers = vec![Vec::new(); count];
        for (node, layer) in layer.iter().enumerate() {
            layers[*layer].push(node);
        }
        let mut widths = widths.to_vec();
        let mut chains = Vec::new();
        for edge in &graph.edges {
            let mut chain = Vec::new();
            if layer[edge.consumer] < layer[edge.provider] {
                chain.push(edge.consumer);
                for between in &mut layers[layer[edge.consumer] + 1..layer[edge.provider]] {
                    between.push(widths.len());
                    chain.push(widths.len());
                    widths.push(LANE);
                }
                chain.push(edge.provider);
            }
            chains.push(chain);
        }
        let mut above = vec![Vec::new(); widths.len()];
        let mut below = vec![Vec::new(); widths.len()];
        for pair in chains.iter().flat_map(|chain| chain.windows(2)) {
            below[pair[0]].push(pair[1]);
            above[pair[1]].push(pair[0]);
        }
        let x = vec![0.0; widths.len()];
        Self { layers, widths, x, chains, above, below }
    }

    /// Orders every layer by the mean place of the neighbours, back and forth; keeps the order
    /// with the fewest crossings.
    fn sort(&mut self) {
        let mut best = (self.crossings(), self.layers.clone());
        for sweep in 0..ORDER_SWEEPS {
            let downwards = sweep % 2 == 0;
            for step in 0..self.layers.len() {
                let place = self.rank();
                let layer = if downwards { step } else { self.layers.len() - 1 - step };
                let neighbours = if downwards { &self.above } else { &self.below };
                let key = |item: &usize| mean(&neighbours[*item], &place).unwrap_or(place[*item]);
                self.layers[layer].sort_by(|a, b| key(a).total_cmp(&key(b)));
            }
            let crossings = self.crossings();
            if crossings < best.0 {
                best = (crossings, self.layers.clone());
            }
        }
        self.layers = best.1;
    }

    /// Rank of every item in its layer, from 0 to 1.
    fn rank(&self) -> Vec<f64> {
        let mut rank = vec![0.0; self.widths.len()];
        for layer in &self.layers {
            let mut before = 0.5;
            for item in layer {
                rank[*item] = before / count(layer.len());
                before += 1.0;
            }
        }
        rank
    }

    fn crossings(&self) -> usize {
        let rank = self.rank();
        let mut crossings = 0;
        for layer in &self.layers {
            let links: Vec<(f64, f64)> = layer
                .iter()
                .flat_map(|top| self.below[*top].iter().map(|low| (rank[*top], rank[*low])))
                .collect();
            for (i, a) in links.iter().enumerate() {
                crossings += links[..i].iter().filter(|b| (a.0 - b.0) * (a.1 - b.1) < 0.0).count();
            }
        }
        crossings
    }

    /// Moves every item towards its neighbours, as far as the order and the room allow.
    fn place(&mut self) {
        for layer in 0..self.layers.len() {
            self.settle(layer, |sheet, item| sheet.x[item]);
        }
        for sweep in 0..PLACE_SWEEPS {
            for step in 0..self.layers.len() {
                let layer = if sweep % 2 == 0 { step } else { self.layers.len() - 1 - step };
                self.settle(layer, |sheet, item| {
                    let around: Vec<usize> =
                        sheet.above[item].iter().chain(&sheet.below[item]).copied().collect();
                    mean(&around, &sheet.x).unwrap_or(sheet.x[item])
                });
            }
        }
    }

    /// Places a layer as near as possible (in squares) to where its items want to be: with the
    /// least distances taken out, that is the nearest ascending sequence, found by pooling.
    fn settle(&mut self, layer: usize, wanted: impl Fn(&Self, usize) -> f64) {
        let mut pools: Vec<(f64, usize)> = Vec::new();
        let mut offsets = Vec::new();
        let (mut offset, mut before) = (0.0, None);
        for &item in &self.layers[layer] {
            if let Some(before) = before {
                offset += f64::midpoint(self.widths[before], self.widths[item]) + GAP;
            }
            before = Some(item);
            offsets.push(offset);
            pools.push((wanted(self, item) - offset, 1));
            while let [.., (left, n), (right, m)] = pools[..]
                && left > right
            {
                pools.truncate(pools.len() - 2);
                let both = (left * count(n) + right * count(m)) / count(n + m);
                pools.push((both, n + m));
            }
        }
        let places = pools.iter().flat_map(|(value, n)| std::iter::repeat_n(*value, *n));
        for ((item, offset), place) in self.layers[layer].iter().zip(offsets).zip(places) {
            self.x[*item] = place + offset;
        }
    }

    fn edge_of_all(&self, side: impl Fn(f64, f64) -> f64, fold: impl Fn(f64, f64) -> f64) -> f64 {
        let sides = self.widths.iter().zip(&self.x).map(|(width, x)| side(*width, *x));
        sides.reduce(fold).unwrap_or(0.0)
    }
}

fn mean(items: &[usize], value: &[f64]) -> Option<f64> {
    let sum: f64 = items.iter().map(|item| value[*item]).sum();
    (!items.is_empty()).then(|| sum / count(items.len()))
}

/// A count of things on a page as a number; more than 2^32 do not fit on one.
fn count(things: usize) -> f64 {
    u32::try_from(things).map_or(f64::from(u32::MAX), f64::from)
}
