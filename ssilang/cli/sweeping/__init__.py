"""`ssilang sweep`: one deck over many parameters and ground motions."""
