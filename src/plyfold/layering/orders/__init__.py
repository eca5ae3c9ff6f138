"""Orders of sheets over one immersion (§3 of the paper)."""
