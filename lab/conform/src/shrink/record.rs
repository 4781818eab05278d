//! Records made smaller and rounder while they still show what they showed.
//!
//! Works on the JSON value of a record: what may be left out, and what is a list or a number, is
//! what reads as a record without it.

use std::time::Instant;

use serde_json::{Value, json};

use crate::cases::question::Question;

/// A record that shows the class.
pub struct Case<'a> {
    /// As JSON.
    pub value: Value,
    /// As what it asks.
    pub question: Question,
    /// Whether a record still shows the class.
    pub shows: &'a mut dyn FnMut(&Question) -> bool,
    /// When nothing is tried any more: what is no record is never asked about, and takes its time all the same.
    pub until: Instant,
}

impl Case<'_> {
    /// Makes a change if it leaves a record that still shows the class.
    pub fn change(&mut self, change: impl FnOnce(&mut Value)) -> bool {
        if self.is_over() {
            return false;
        }
        let mut changed = self.value.clone();
        change(&mut changed);
        if changed == self.value {
            return false;
        }
        let Some(question) = Question::of_line(&changed.to_string()) else { return false };
        let shows = (self.shows)(&question);
        if shows {
            (self.value, self.question) = (changed, question);
        }
        shows
    }

    fn is_over(&self) -> bool {
        Instant::now() >= self.until
    }

    /// Changes the values at these places, all at once.
    pub fn change_at(&mut self, places: &[String], new: impl Fn(&Value) -> Option<Value>) -> bool {
        self.change(|record| {
            for place in places {
                if let Some(old) = record.pointer_mut(place)
                    && let Some(new) = new(old)
                {
                    *old = new;
                }
            }
        })
    }

    /// Puts the first of these values that will do at a place.
    pub fn put<T: Into<Value>>(
        &mut self,
        place: &str,
        values: impl IntoIterator<Item = T>,
    ) -> bool {
        let places = [place.to_owned()];
        values.into_iter().map(T::into).any(|it| self.change_at(&places, |_| Some(it.clone())))
    }

    /// Leaves out what may be absent, the longest first; the profile stays what it was.
    pub fn keys(&mut self) {
        let mut places = Vec::new();
        for (name, field) in self.value.as_object().into_iter().flatten() {
            places.push((field.to_string().len(), String::new(), name.clone()));
            for (inner, value) in field.as_object().into_iter().flatten() {
                places.push((value.to_string().len(), format!("/{name}"), inner.clone()));
            }
        }
        places.sort_by(|a, b| b.cmp(a));
        for (_, pointer, name) in places.into_iter().filter(|(_, _, name)| name != "profile") {
            self.change(|record| {
                if let Some(Value::Object(fields)) = record.pointer_mut(&pointer) {
                    fields.remove(&name);
                }
            });
        }
    }

    /// Thins every list, the outer ones first.
    pub fn lists(&mut self) {
        let mut open = vec![String::new()];
        while let Some(pointer) = open.pop().filter(|_| !self.is_over()) {
            self.thin(&pointer);
            match self.value.pointer(&pointer) {
                Some(Value::Object(fields)) => {
                    open.extend(fields.keys().map(|name| format!("{pointer}/{name}")));
                }
                Some(Value::Array(items)) => {
                    open.extend((0..items.len()).map(|index| format!("{pointer}/{index}")));
                }
                _ => {}
            }
        }
    }

    /// Removes as many items of a list as possible.
    fn thin(&mut self, pointer: &str) {
        let Some(items) = self.value.pointer(pointer).and_then(Value::as_array).cloned() else {
            return;
        };
        let place = [pointer.to_owned()];
        let until = self.until;
        let is_over = || Instant::now() >= until;
        thinned(items, &is_over, &mut |fewer| self.change_at(&place, |_| Some(fewer.into())));
    }

    /// Stations and ids become 0 or 1; the times of events 0, or the time of the event before;
    /// what is true becomes false.
    pub fn simple(&mut self) {
        let times = leaves(&self.value, |place, _| {
            place.starts_with("/events/")
                && place.ends_with("/t_ns")
                && place.matches('/').count() == 3
        });
        self.change_at(&times, |_| Some(json!(0)));
        let mut before = 0_i64;
        for place in &times {
            self.put(place, [before, before.saturating_add(1)]);
            before = self.value.pointer(place).and_then(Value::as_i64).unwrap_or(0);
        }
        let names = |place: &str, value: &Value| {
            value.is_i64() && (place.ends_with("/station") || place.ends_with("/id"))
        };
        for place in leaves(&self.value, names) {
            self.put(&place, [0, 1]);
        }
        for place in leaves(&self.value, |_, value| value == &json!(true)) {
            self.put(&place, [false]);
        }
    }
}

/// Leaves out all, halves, quarters, and so on to single items, from the end, while what stays still shows.
pub fn thinned<T: Clone>(
    mut items: Vec<T>,
    is_over: &dyn Fn() -> bool,
    shows: &mut dyn FnMut(&[T]) -> bool,
) -> Vec<T> {
    let mut size = items.len();
    while size > 0 {
        let mut end = items.len();
        while end > 0 && !is_over() {
            let start = end.saturating_sub(size);
            let fewer = [&items[..start], &items[end..]].concat();
            if shows(&fewer) {
                items = fewer;
            }
            end = start;
        }
        size /= 2;
    }
    items
}

/// The places, as JSON pointers, of the values that are no list and no object, and wanted.
pub fn leaves(record: &Value, wanted: impl Fn(&str, &Value) -> bool) -> Vec<String> {
    let (mut found, mut open) = (Vec::new(), vec![(String::new(), record)]);
    while let Some((pointer, value)) = open.pop() {
        match value {
            // Taken from the end: in the order of the record.
            Value::Object(fields) => {
                open.extend(fields.iter().rev().map(|(key, it)| (format!("{pointer}/{key}"), it)));
            }
            Value::Array(items) => {
                let items = items.iter().enumerate().rev();
                open.extend(items.map(|(index, it)| (format!("{pointer}/{index}"), it)));
            }
            leaf if wanted(&pointer, leaf) => found.push(pointer),
            _ => {}
        }
    }
    found
}
