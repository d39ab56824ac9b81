"""Records of ground motions: integration, correction, spectra, artificial signals, wavelets."""
