"""SEG-Y files: layout, lines, reading and writing."""
