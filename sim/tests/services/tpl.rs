//! tpl
