"""Many random curves against the slow references, and against themselves in other frames: ``make nightly``."""
