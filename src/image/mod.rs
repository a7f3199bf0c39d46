//! Reading photographs and measuring facets.
