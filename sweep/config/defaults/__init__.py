"""What a config leaves open: values that follow from others, from the loading, or from a slicer."""
