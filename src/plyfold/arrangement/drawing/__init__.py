"""Drawing a round closed curve with a given signed Gauss code."""
