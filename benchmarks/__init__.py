"""What branchcrush takes, by itself and beside other codes: `make bench`, or one part of it."""
