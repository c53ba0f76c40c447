//! krawl follows the real homotopy path through a sketch and finds, with proof, the figures on it
//! that meet the dimensions.

pub mod certificate;
pub mod interval;
pub mod linalg;
pub mod plan;
pub mod problem;
pub mod report;
pub mod system;
pub mod track;
