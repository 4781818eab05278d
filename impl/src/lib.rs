//! placeholder
#![no_std]
pub mod configuration;
