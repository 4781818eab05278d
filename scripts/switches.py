"""Many changes of Rust sources at once, each behind a switch: `MUFASA_CHANGE=12` makes the twelfth, and `MUFASA_REACHED` names a file
for the numbers of those that are reached. For scripts/mutants-code."""

import sys
from collections import defaultdict
from pathlib import Path

import tree_sitter_rust
from tree_sitter import Language, Parser

PARSER = Parser(Language(tree_sitter_rust.language()))
SWITCH = """
/// Which change was chosen, and a file for the numbers of those that a test comes to.
mod change {
    extern crate std;
    use std::{env::var, fs::OpenOptions, io::Write, option::Option, string::ToString, sync::LazyLock};
    use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
    static CHOSEN: LazyLock<Option<u32>> = LazyLock::new(|| var("MUFASA_CHANGE").ok()?.parse().ok());
    static REACHED: LazyLock<Option<std::string::String>> = LazyLock::new(|| var("MUFASA_REACHED").ok());
    static SEEN: [AtomicBool; 20_000] = [const { AtomicBool::new(false) }; 20_000];
    pub fn is(number: u32) -> bool {
        if let Some(file) = &*REACHED && !SEEN[number as usize].swap(true, Relaxed) {
            let mut file = OpenOptions::new().create(true).append(true).open(file).unwrap();
            file.write_all((number.to_string() + "\n").as_bytes()).unwrap();
        }
        *CHOSEN == Some(number)
    }
}
"""
# What is computed while a program is compiled cannot ask for a switch.
CONSTANT = {"const_item", "static_item", "const_block", "array_type", "enum_variant"}
WITH_OPERATOR = {"binary_expression", "compound_assignment_expr", "unary_expression"}


def with_switches(folder, package, changes):
    """Writes the sources of a package with these changes, and says which of them have a switch: a dict by number."""
    by_file, switched = defaultdict(dict), {}
    for number, change in changes.items():
        by_file[change["file"]][number] = change
    sys.setrecursionlimit(20_000)
    for name, those in by_file.items():
        file = Path(folder, name)
        source = file.read_bytes()
        tree = PARSER.parse(source)
        before, instead = defaultdict(str), defaultdict(list)
        for number, change in those.items():
            if place(tree.root_node, source, number, change, before, instead):
                switched[number] = change
        file.write_text(rendered(tree.root_node, source, before, instead))
    root = Path(folder, package, "src", "lib.rs")
    root.write_text(root.read_text() + SWITCH)
    return switched


def place(root, source, number, change, before, instead):
    """Notes where a change goes: at a byte, or in place of a node. False if it cannot have a switch."""
    start, end = (offset(source, change["span"][it]) for it in ("start", "end"))
    node, to = root.descendant_for_byte_range(start, end), change["replacement"]
    above = list(ancestors(node))
    modifiers = [part.text for it in above if it.type == "function_item" for part in it.children if part.type == "function_modifiers"]
    if any(it.type in CONSTANT for it in above) or any(b"const" in it for it in modifiers):
        return False
    if change["genre"] == "FnValue":
        function = next(it for it in above if it.type == "function_item")
        before[function.child_by_field_name("body").start_byte + 1] += f" if crate::change::is({number}) {{ return {to}; }}"
    elif change["genre"] in ("BinaryOperator", "UnaryOperator") and above[1].type in WITH_OPERATOR:
        whole = above[1]
        text = source[whole.start_byte:start] + to.encode() + source[end:whole.end_byte]
        instead[whole.id].append((number, text.decode()))
    elif change["genre"] == "MatchArmGuard":
        instead[node.id].append((number, to))
    else:
        return False
    return True


def rendered(node, source, before, instead):
    """The text of a node, in which each change has its switch."""
    parts, at = [], node.start_byte
    for child in node.children:
        parts += [source[at:child.start_byte].decode(), rendered(child, source, before, instead)]
        at = child.end_byte
    parts += [source[at:node.end_byte].decode(), before.get(node.end_byte, "") if not node.children else ""]
    text = "".join(parts)
    if node.id not in instead:
        return text
    choices = "".join(f"if crate::change::is({number}) {{ {other} }} else " for number, other in instead[node.id])
    return f"({choices}{{ {text} }})"


def refused(said, folder):
    """The numbers of the changes at which the compiler found errors."""
    numbers = set()
    for span in (it for message in said if message["level"] == "error" for it in message["spans"] if it["is_primary"]):
        until = Path(folder, span["file_name"]).read_bytes()[:span["byte_end"]].decode()
        *_, last = until.split("crate::change::is(")
        if last != until:
            numbers.add(int(last.split(")")[0]))
    return numbers


def ancestors(node):
    while node:
        yield node
        node = node.parent


def offset(source, position):
    """The byte of a line and a column, which are from 1."""
    lines = source.split(b"\n")[:position["line"]]
    return sum(len(it) + 1 for it in lines[:-1]) + len(lines[-1].decode()[:position["column"] - 1].encode())
