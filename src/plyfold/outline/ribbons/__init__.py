"""Lines with a width: ribbons that are immersed disks and rings by construction."""
