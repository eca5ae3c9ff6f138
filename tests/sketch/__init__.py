"""The sketching page: its server, its files, and itself in a browser."""
