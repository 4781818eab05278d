//! A WebAssembly module, as much of it as the machine needs.

use std::collections::HashMap;

use wasmparser::{
    BinaryReaderError, CompositeInnerType, ConstExpr, DataKind, ElementItems, ElementKind,
    ExternalKind, FuncType, Operator, Parser, Payload, TypeRef, ValType,
};

/// A function of the module.
#[derive(Debug)]
pub enum Function<'a> {
    /// Of the module `env`, by name.
    Import(&'a str, FuncType),
    /// With a body.
    Body(Body<'a>),
}

/// Code with what its structure says.
#[derive(Debug)]
pub struct Body<'a> {
    /// Parameters and results.
    pub of: FuncType,
    /// Types of locals, parameters first.
    pub locals: Vec<ValType>,
    /// The instructions; the last is `End`.
    pub code: Vec<Operator<'a>>,
    /// For every `Block`, `Loop`, `If` and `Else` its `Else` or `End`.
    pub next: Vec<usize>,
}

/// The module.
#[derive(Debug, Default)]
pub struct Module<'a> {
    /// Imports first.
    pub functions: Vec<Function<'a>>,
    /// First values of globals, and their widths.
    pub globals: Vec<(u64, u8)>,
    /// Places of the table of functions.
    pub table: HashMap<u64, u32>,
    /// What memory holds at first: address and bytes.
    pub data: Vec<(u64, &'a [u8])>,
    /// Bytes of memory that are used: up to the exported `__heap_base`.
    pub memory: u64,
    /// Exported functions.
    pub exports: HashMap<&'a str, u32>,
    types: Vec<FuncType>,
}

impl<'a> Module<'a> {
    /// Reads a module. Errors say what there is no support for.
    pub fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let mut module = Self::default();
        module.fill(bytes).map_err(|error| error.to_string())??;
        Ok(module)
    }

    fn fill(&mut self, bytes: &'a [u8]) -> Result<Result<(), String>, BinaryReaderError> {
        let (mut kinds, mut bodies, mut heap) = (Vec::new(), 0, None);
        for payload in Parser::new(0).parse_all(bytes) {
            match payload? {
                Payload::TypeSection(section) => {
                    for group in section {
                        for sub in group?.into_types() {
                            let CompositeInnerType::Func(of) = sub.composite_type.inner else {
                                return Ok(Err("a type that is no function".to_owned()));
                            };
                            self.types.push(of);
                        }
                    }
                }
                Payload::ImportSection(section) => {
                    for import in section.into_imports() {
                        let import = import?;
                        let TypeRef::Func(of) = import.ty else {
                            return Ok(Err(format!(
                                "an import that is no function: {}",
                                import.name
                            )));
                        };
                        let of = self.types[of as usize].clone();
                        self.functions.push(Function::Import(import.name, of));
                    }
                }
                Payload::FunctionSection(section) => {
                    kinds = section.into_iter().collect::<Result<Vec<u32>, _>>()?;
                }
                Payload::GlobalSection(section) => {
                    for global in section {
                        let global = global?;
                        let Some(width) = width(global.ty.content_type) else {
                            return Ok(Err("a global that is no integer".to_owned()));
                        };
                        self.globals.push((constant(&global.init_expr)?, width));
                    }
                }
                Payload::ExportSection(section) => {
                    for export in section {
                        let export = export?;
                        match export.kind {
                            ExternalKind::Func => {
                                self.exports.insert(export.name, export.index);
                            }
                            ExternalKind::Global if export.name == "__heap_base" => {
                                heap = Some(export.index as usize);
                            }
                            _ => {}
                        }
                    }
                }
                Payload::ElementSection(section) => {
                    for element in section {
                        let element = element?;
                        let ElementKind::Active { offset_expr, .. } = element.kind else {
                            continue;
                        };
                        let ElementItems::Functions(functions) = element.items else {
                            return Ok(Err("a table of expressions".to_owned()));
                        };
                        for (place, function) in (constant(&offset_expr)?..).zip(functions) {
                            self.table.insert(place, function?);
                        }
                    }
                }
                Payload::DataSection(section) => {
                    for data in section {
                        let data = data?;
                        let DataKind::Active { offset_expr, .. } = data.kind else { continue };
                        self.data.push((constant(&offset_expr)?, data.data));
                    }
                }
                Payload::CodeSectionEntry(body) => {
                    let of: &FuncType = &self.types[kinds[bodies] as usize];
                    bodies += 1;
                    let mut locals = of.params().to_vec();
                    for local in body.get_locals_reader()? {
                        let (count, kind) = local?;
                        locals.extend(std::iter::repeat_n(kind, count as usize));
                    }
                    let code: Vec<_> =
                        body.get_operators_reader()?.into_iter().collect::<Result<_, _>>()?;
                    let next = structure(&code);
                    self.functions.push(Function::Body(Body {
                        of: of.clone(),
                        locals,
                        code,
                        next,
                    }));
                }
                _ => {}
            }
        }
        let Some(heap) = heap else { return Ok(Err("no __heap_base is exported".to_owned())) };
        self.memory = self.globals[heap].0;
        Ok(Ok(()))
    }

    /// Parameters and results of the type of this number.
    pub fn kind(&self, number: u32) -> &FuncType {
        &self.types[number as usize]
    }
}

/// Bits of an integer.
pub const fn width(kind: ValType) -> Option<u8> {
    match kind {
        ValType::I32 => Some(32),
        ValType::I64 => Some(64),
        _ => None,
    }
}

fn constant(expression: &ConstExpr<'_>) -> Result<u64, BinaryReaderError> {
    let first = expression.get_operators_reader().read()?;
    Ok(match first {
        Operator::I32Const { value } => value.cast_unsigned().into(),
        Operator::I64Const { value } => value.cast_unsigned(),
        other => panic!("no constant: {other:?}"),
    })
}

fn structure(code: &[Operator<'_>]) -> Vec<usize> {
    let mut next = vec![0; code.len()];
    let mut open = Vec::new();
    for (place, operator) in code.iter().enumerate() {
        match operator {
            Operator::Block { .. } | Operator::Loop { .. } | Operator::If { .. } => {
                open.push(place);
            }
            Operator::Else => {
                let start = open.pop().expect("an if");
                next[start] = place;
                open.push(place);
            }
            Operator::End => {
                if let Some(start) = open.pop() {
                    next[start] = place;
                }
            }
            _ => {}
        }
    }
    next
}
