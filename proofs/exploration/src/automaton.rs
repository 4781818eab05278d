//! A part of the system (a requester, a station) as a finite automaton, found by running it.
//!
//! The real part is stepped, never a copy of its rules. States that behave alike have the same
//! [`Part::Likeness`]; one real part per likeness stands for all of them. That they do behave
//! alike is argued where the likeness is made and tested on pairs of parts that differ in
//! everything that the likeness leaves out (`proofs/exploration/tests/exploration/likeness.rs`).

use std::collections::{HashMap, VecDeque};
use std::hash::Hash;

use indexmap::IndexSet;

use super::fit::fitted;
use mufasa_props::refine::Difference;

/// Something that reacts.
pub trait Part: Clone {
    /// What decides how it reacts, relative to now.
    type Likeness: Clone + Eq + Hash;
    /// What may happen to it.
    type Stimulus: Copy + Eq + Hash;
    /// What it does then.
    type Effect: Clone + Eq + Hash;

    /// Equal for two parts that behave alike.
    fn likeness(&mut self) -> Self::Likeness;

    /// What happens to it then, or `None` when that cannot happen in this state. Errors: model
    /// and implementation differ.
    fn react(
        &self,
        stimulus: Self::Stimulus,
    ) -> Result<Option<(Self, Self::Effect)>, Box<Difference>>;
}

/// All states that a part can come into, and all its reactions.
#[derive(Debug)]
pub struct Automaton<P: Part> {
    stimuli: Vec<P::Stimulus>,
    places: HashMap<P::Stimulus, usize>,
    likenesses: IndexSet<P::Likeness>,
    /// By state and stimulus: the next state and the effect; `None`: it cannot come.
    reactions: Vec<Option<(u32, u32)>>,
    effects: IndexSet<P::Effect>,
}

impl<P: Part> Automaton<P> {
    /// Runs the part from its start through every sequence of stimuli. The start has the id 0.
    /// Errors: model and implementation differ in one reaction.
    pub fn explore(mut start: P, stimuli: Vec<P::Stimulus>) -> Result<Self, Box<Difference>> {
        let mut automaton = Self {
            places: stimuli.iter().copied().zip(0..).collect(),
            stimuli,
            likenesses: IndexSet::from([start.likeness()]),
            reactions: Vec::new(),
            effects: IndexSet::new(),
        };
        let mut waiting = VecDeque::from([start]);
        while let Some(part) = waiting.pop_front() {
            for place in 0..automaton.stimuli.len() {
                let reaction = part.react(automaton.stimuli[place])?.map(|(mut next, effect)| {
                    let (id, is_new) = automaton.likenesses.insert_full(next.likeness());
                    if is_new {
                        waiting.push_back(next);
                    }
                    let (effect, _) = automaton.effects.insert_full(effect);
                    (fitted(id), fitted(effect))
                });
                automaton.reactions.push(reaction);
            }
        }
        Ok(automaton)
    }

    /// Number of states.
    #[allow(clippy::len_without_is_empty, reason = "there is always a start")]
    pub fn len(&self) -> usize {
        self.likenesses.len()
    }

    /// Number of reactions, each of which was checked.
    pub fn reactions(&self) -> usize {
        self.reactions.iter().flatten().count()
    }

    /// All stimuli in order.
    pub fn stimuli(&self) -> &[P::Stimulus] {
        &self.stimuli
    }

    /// The place of a stimulus among all, if it is one of them.
    pub fn place(&self, stimulus: &P::Stimulus) -> Option<usize> {
        self.places.get(stimulus).copied()
    }

    /// The state that is like this, if one was reached.
    pub fn id(&self, likeness: &P::Likeness) -> Option<u32> {
        self.likenesses.get_index_of(likeness).map(fitted)
    }

    /// What the state is like.
    pub fn likeness(&self, id: u32) -> &P::Likeness {
        &self.likenesses[id as usize]
    }

    /// The next state and what is done, or `None` when the stimulus cannot come in this state.
    pub fn react(&self, id: u32, place: usize) -> Option<(u32, &P::Effect)> {
        let (next, effect) = self.reactions[id as usize * self.stimuli.len() + place]?;
        Some((next, &self.effects[effect as usize]))
    }
}
