"""Ground motions in the formats of databases (PEER, ESM, ITACA, COSMOS) and tables with titles."""
