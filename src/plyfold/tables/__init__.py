"""Tables of many rows: columns, the files they are written to, and parts that are made by all cores."""
