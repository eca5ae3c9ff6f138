"""The command line: a room for each subcommand. The library does the work; only these modules print."""
