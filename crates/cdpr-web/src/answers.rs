//! What the models answer, a file for each kind of question.

pub(crate) mod deflect;
pub(crate) mod describe;
pub(crate) mod failure;
pub(crate) mod follow;
pub(crate) mod modes;
pub(crate) mod observe;
pub(crate) mod slice;
pub(crate) mod stand;
pub(crate) mod state;
