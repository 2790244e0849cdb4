"""Oil supply and starved films."""
