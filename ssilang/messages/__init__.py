"""Every sentence that a refusal or a warning says, English and French side by side."""
