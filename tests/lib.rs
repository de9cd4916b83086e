//! Shared helpers of the tests; the tests themselves are the files beside this one.
