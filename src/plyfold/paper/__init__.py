"""The paper's own procedures, judged by the exact ones (§2.3, §2.4, §3 of the paper)."""
